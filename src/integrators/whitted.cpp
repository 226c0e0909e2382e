// SPDX-License-Identifier: MIT

// [1] Whitted 1980, "An Improved Illumination Model for Shaded Display"

#include "integrators/delta_chain.h"
#include "integrators/direct_light.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"

namespace plumb {

/// Emission, direct light, and what is seen in mirrors and through smooth glass (Whitted 1980).
///
/// One sample of one emitter, chosen by what it is expected to send there, at the first surface that is not delta;
/// delta bounces are followed with probability 0.95 each, and weighted by its inverse. No parameters.
///
///         <integrator type="whitted"/>
class Whitted final : public Integrator, public DeltaChain {
public:
    explicit Whitted(const Params&) {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return trace_path(*this, tracer, sampler, ray);
    }

    std::string bias() const override { return "light between surfaces that are not smooth is omitted"; }
    bool notes_light() const override { return true; }

    Color direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
    {
        return light_from_one_emitter(tracer, sampler, vertex);
    }
    int max_depth() const { return -1; }
    float survival(const PathState&, int) const { return 0.95f; }
};

template std::unique_ptr<Integrator> build<Whitted>(const Params&);

} // namespace plumb
