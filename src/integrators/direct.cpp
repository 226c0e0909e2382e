// SPDX-License-Identifier: MIT

#include "integrators/delta_chain.h"
#include "integrators/direct_technique.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"

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
    bool notes_light() const override { return true; }

    Color direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
    {
        if (!vertex.has_smooth_lobes()) return Color(0.f);
        Color sum(0.f);
        const std::size_t all = tracer.noted_light();
        for (int i = 0; i < technique_.samples(); ++i) {
            const std::size_t noted = tracer.noted_light();
            const Color found = technique_.estimate(tracer, sampler, vertex);
            tracer.change_noted_light(noted, [&](const Color& one) { return sum + one; });
            sum += found;
        }
        const auto samples = static_cast<float>(technique_.samples());
        tracer.change_noted_light(all, [&](const Color& part) { return part / samples; });
        return sum / samples;
    }

private:
    DirectTechnique technique_;
};

template std::unique_ptr<Integrator> build<Direct>(const Params&);

} // namespace plumb
