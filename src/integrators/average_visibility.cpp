// SPDX-License-Identifier: MIT

#include "integrators/see_through.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"
#include "plumb/model/sampler.h"
#include "plumb/sampling/sampling.h"
#include "plumb/scene/tracer.h"

namespace plumb {

/// Average visibility: the fraction of directions in which nothing is met within a given length of the first hit.
///
/// Directions are uniform over the hemisphere about the shading normal; those below the true surface count as
/// blocked. White where the camera sees nothing.
///
///     length   float   how far occluders reach, in units of the scene   (required)
///
///         <integrator type="av">
///             <float name="length" value="0.5"/>
///         </integrator>
class AverageVisibility final : public Integrator {
public:
    explicit AverageVisibility(const Params& params)
        : length_(params.number("length", 1.f, Range::positive()))
    {
        if (!params.has("length"))
            params.fail("length", "must be given: how far occluders reach, in units of the scene");
    }

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        float sum = 0.f;
        see_through(tracer, ray, [&](const SurfacePoint* at, float fraction, float opacity) {
            if (opacity > 0.f) sum += fraction * opacity * (at ? visibility(tracer, sampler, *at) : 1.f);
        });
        return Color(sum);
    }

    std::string bias() const override { return "it shows visibility, not light"; }
    bool needs_lamps() const override { return false; }

private:
    float visibility(Tracer& tracer, Sampler& sampler, const SurfacePoint& at) const
    {
        const Vec3f direction = at.shading.to_world(square_to_uniform_hemisphere(sampler.next_2d()));
        if (dot(direction, at.geometric_normal) <= 0.f) return 0.f;
        Ray probe = at.spawn_ray(direction);
        probe.t_max = length_;
        return tracer.transmittance(probe);
    }

    float length_;
};

template std::unique_ptr<Integrator> build<AverageVisibility>(const Params&);

} // namespace plumb
