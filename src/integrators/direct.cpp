// SPDX-License-Identifier: MIT

#include "integrators/direct_technique.h"
#include "integrators/discrete_chain.h"
#include "interfaces/plugin.h"
#include "plumb/integrator.h"

namespace plumb {

/// Emission and direct light from all lights, by the technique of your choice.
///
/// Without parameters every emitter is sampled once. Emitters reflected by delta BSDFs (mirror, smooth glass) are
/// seen too, and lights that a technique cannot find (point and directional ones by hemisphere or bsdf) are sampled
/// directly, so that all techniques agree.
///
///     measure     string    how emitters are found: area or solid-angle (one sample of each), hemisphere or bsdf (a direction)   (default: by solid angle where possible, else by area)
///     nSamples    integer   samples at each surface point, averaged   (default 1)
///     warp-type   string    for measure hemisphere: cosine-hemisphere, uniform-hemisphere or none   (default none: cosine)
///
///         <integrator type="direct">
///             <string name="measure" value="solid-angle"/>
///             <integer name="nSamples" value="4"/>
///         </integrator>
class Direct final : public Integrator, public SingleDiscreteBounce {
public:
    explicit Direct(const Params& params)
        : technique_(params, "measure", "nSamples", "warp-type", DirectTechnique::Kind::best)
    {}

    void prepare(const Scene& scene) override { technique_.prepare(scene); }

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return trace_path(*this, tracer, sampler, ray);
    }

    std::string bias() const override { return bias_of_depth(max_depth()); }

    Color direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
    {
        if (!vertex.has_smooth_lobes()) return Color(0.f);
        Color sum(0.f);
        for (int i = 0; i < technique_.samples(); ++i) sum += technique_.estimate(tracer, sampler, vertex);
        return sum / static_cast<float>(technique_.samples());
    }

private:
    DirectTechnique technique_;
};

template std::unique_ptr<Integrator> build<Direct>(const Params&);

} // namespace plumb
