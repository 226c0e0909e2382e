// SPDX-License-Identifier: MIT

#include "integrators/delta_chain.h"
#include "integrators/direct_light.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"

namespace plumb {

/// Emission and direct light, by one sample of every emitter.
///
/// Emitters reflected by delta BSDFs (mirror, smooth glass) are seen too. No parameters.
///
///         <integrator type="direct_whitted"/>
class DirectWhitted final : public Integrator, public SingleDiscreteBounce {
public:
    explicit DirectWhitted(const Params&) {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return trace_path(*this, tracer, sampler, ray);
    }

    std::string bias() const override { return bias_of_depth(max_depth()); }
    bool notes_light() const override { return true; }

    Color direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
    {
        return light_from_all_emitters(tracer, sampler, vertex, Measure::best);
    }
};

template std::unique_ptr<Integrator> build<DirectWhitted>(const Params&);

} // namespace plumb
