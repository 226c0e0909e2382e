// SPDX-License-Identifier: MIT

#include "integrators/direct_light.h"
#include "integrators/see_through.h"
#include "model/plugin.h"
#include "plumb/model/integrator.h"

namespace plumb {

/// Direct light from points, with shadows.
///
/// With parameters, from a point light of its own onto white diffuse surfaces, whatever their BSDF:
/// energy / (4 pi^2) max(0, cos(theta)) / d^2 where the light is visible. Without parameters, from the scene's point
/// and directional lights, each scattered by the surface's BSDF. Emitters are black.
///
///     position   point   where the light is   (required with energy)
///     energy     color   its power in watts   (required with position)
///
///         <integrator type="simple">
///             <point name="position" value="-20 40 20"/>
///             <color name="energy" value="3.76e4 3.76e4 3.76e4"/>
///         </integrator>
class Simple final : public Integrator {
public:
    explicit Simple(const Params& params) : own_light_(params.has("position") || params.has("energy"))
    {
        if (!own_light_) return;
        position_ = params.point("position", Vec3f(0.f));
        energy_ = params.color("energy");
        if (!params.has("position")) params.fail("position", "must be given with energy: where the light is");
    }

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        Color sum(0.f);
        see_through(tracer, ray, [&](const SurfacePoint* at, float fraction, float opacity) {
            if (!at) return;
            if (own_light_)
                sum += from_own_light(tracer, *at) * (fraction * opacity);
            else
                sum += light_from_all_delta_emitters(tracer, sampler, Vertex(*at, ray.direction)) * fraction;
        });
        return sum;
    }

    std::string bias() const override
    {
        return "it shows only the light of point and directional lights, without bounces";
    }

private:
    Color from_own_light(Tracer& tracer, const SurfacePoint& at) const
    {
        const Vec3f to_light = position_ - at.position;
        const float distance = length(to_light);
        if (!(distance > 0.f)) return Color(0.f);
        EmitterSample light{};
        light.wi = to_light / distance;
        light.distance = distance;
        light.position = position_;
        const float cosine = std::max(0.f, dot(light.wi, at.shading.n));
        if (cosine == 0.f) return Color(0.f);
        const float visible = tracer.visible(at, light);
        if (!(visible > 0.f)) return Color(0.f);
        return energy_ * (cosine / (4.f * sqr(pi) * sqr(distance))) * visible;
    }

    bool own_light_;
    Vec3f position_;
    Color energy_;
};

template std::unique_ptr<Integrator> build<Simple>(const Params&);

} // namespace plumb
