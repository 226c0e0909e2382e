// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/emitter.h"

#include <fmt/format.h>

namespace plumb {

/// Parallel light from infinitely far away, like the sun's.
///
/// `radiance` is the irradiance on a surface that faces the light: a diffuse surface of albedo a that faces it shows
/// a radiance of a / pi times it.
///
/// `direction` is where the light goes, as in Mitsuba and in most forks of Nori: a sun above has a negative y.
///
///     direction        vector    where the light goes, any length but 0   (required)
///     radiance         color     irradiance perpendicular to the direction, in W / m^2   (default 1)
///     pointsToLight    boolean   direction points the other way, towards the light   (default false)
///
///         <emitter type="directional">
///             <vector name="direction" value="-1 -2 -0.5"/>
///             <color name="radiance" value="3 3 2.8"/>
///         </emitter>
class DirectionalEmitter final : public Emitter {
public:
    explicit DirectionalEmitter(const Params& params) : irradiance_(params.color("radiance", Color(1.f)))
    {
        const Vec3f direction = params.vector("direction", Vec3f(0.f));
        const bool points_to_light = params.boolean("pointsToLight", false);
        if (max_component(abs(direction)) > 0.f)
            towards_light_ = normalize(points_to_light ? direction : -direction);
        else
            params.fail(
                "direction",
                fmt::format("must {}: it {}", params.has("direction") ? "not be 0" : "be given",
                            points_to_light ? "points towards the light" : "is where the light goes"));
    }

    void prepare(const SceneSphere& sphere) override
    {
        scene_radius_ = sphere.radius > 0.f ? sphere.radius : 1.f;
    }

    std::optional<EmitterSample> sample(const LightReceiver& receiver, double /*u_select*/,
                                        const Vec2f& /*u*/, Measure /*measure*/) const override
    {
        if (!receiver.counts_light_from(towards_light_)) return std::nullopt;
        EmitterSample sample;
        sample.wi = towards_light_;
        sample.distance = infinity;
        sample.position = Vec3f(0.f);
        sample.radiance = irradiance_;
        sample.pdf = 1.f;
        sample.is_delta = true;
        return sample;
    }

    EmitterValue evaluate(const LightReceiver&, const Vec3f&, const SurfacePoint*, Measure) const override
    {
        return {};
    }

    // What passes through the disk that the scene's sphere fills, seen from the light.
    float power() const override { return pi * sqr(scene_radius_) * luminance(irradiance_); }
    bool is_delta() const override { return true; }
    bool is_infinite() const override { return true; }

private:
    Color irradiance_;
    Vec3f towards_light_{0.f, 0.f, 1.f};
    float scene_radius_ = 1.f;
};

template std::unique_ptr<Emitter> build<DirectionalEmitter>(const Params&);

} // namespace plumb
