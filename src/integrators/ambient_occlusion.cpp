// SPDX-License-Identifier: MIT

// [1] Landis 2002, "Production-Ready Global Illumination", SIGGRAPH course 16

#include "integrators/hemisphere_warp.h"
#include "integrators/see_through.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"
#include "plumb/scene/tracer.h"

namespace plumb {

/// Ambient occlusion: how much of a uniform white sky the first hit sees (Landis 2002).
///
/// The integral of visibility times cos(theta) / pi over the hemisphere about the shading normal, however far away
/// the occluders are: 1 is open, 0 closed. Directions below the true surface count as occluded. Black where the
/// camera sees nothing.
///
///     nSamples    integer   directions at each hit   (default 1)
///     warp-type   string    how directions are chosen: cosine-hemisphere, uniform-hemisphere or none   (default none: cosine)
///
///         <integrator type="ao">
///             <integer name="nSamples" value="4"/>
///         </integrator>
class AmbientOcclusion final : public Integrator {
public:
    explicit AmbientOcclusion(const Params& params)
        : samples_(static_cast<int>(params.integer("nSamples", 1, Range::closed(1, 1e6)))),
          warp_(hemisphere_warp(params, "warp-type"))
    {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        float sum = 0.f;
        see_through(tracer, ray, [&](const SurfacePoint* at, float fraction, float opacity) {
            if (at && opacity > 0.f) sum += fraction * opacity * open_part(tracer, sampler, *at);
        });
        return Color(sum);
    }

    std::string bias() const override { return "it shows visibility, not light"; }
    bool needs_lamps() const override { return false; }

private:
    // Of the cosine-weighted hemisphere.
    float open_part(Tracer& tracer, Sampler& sampler, const SurfacePoint& at) const
    {
        float sum = 0.f;
        for (int i = 0; i < samples_; ++i) {
            const Vec3f w = sample_hemisphere(warp_, sampler.next_2d());
            const float pdf = hemisphere_pdf(warp_, w);
            const Vec3f direction = at.shading.to_world(w);
            const bool leaves = pdf > 0.f && dot(direction, at.geometric_normal) > 0.f;
            if (leaves) sum += tracer.transmittance(at.spawn_ray(direction)) * (cos_theta(w) * inv_pi / pdf);
        }
        return sum / static_cast<float>(samples_);
    }

    int samples_;
    HemisphereWarp warp_;
};

template std::unique_ptr<Integrator> build<AmbientOcclusion>(const Params&);

} // namespace plumb
