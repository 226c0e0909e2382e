// SPDX-License-Identifier: MIT

#include "interfaces/plugin.h"
#include "plumb/integrator.h"
#include "plumb/sampler.h"
#include "plumb/sampling.h"
#include "plumb/tracer.h"

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
        const auto hit = tracer.intersect(ray, RayKind::camera);
        if (!hit) return Color(1.f);
        const Vec3f direction = hit->shading.to_world(square_to_uniform_hemisphere(sampler.next_2d()));
        if (dot(direction, hit->geometric_normal) <= 0.f) return Color(0.f);
        Ray probe = hit->spawn_ray(direction);
        probe.t_max = length_;
        return Color(tracer.occluded(probe) ? 0.f : 1.f);
    }

    std::string bias() const override { return "it shows visibility, not light"; }
    bool needs_lamps() const override { return false; }

private:
    float length_;
};

template std::unique_ptr<Integrator> build<AverageVisibility>(const Params&);

} // namespace plumb
