// SPDX-License-Identifier: MIT

#include "integrators/direct_light.h"
#include "integrators/discrete_chain.h"
#include "interfaces/plugin.h"
#include "plumb/integrator.h"

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

    Color direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
    {
        return light_from_all_emitters(tracer, sampler, vertex, Measure::best);
    }
};

template std::unique_ptr<Integrator> build<DirectWhitted>(const Params&);

} // namespace plumb
