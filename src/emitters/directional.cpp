// SPDX-License-Identifier: MIT

#include "interfaces/plugin.h"
#include "plumb/emitter.h"

namespace plumb {

/// Parallel light from infinitely far away, like the sun's.
///
/// `radiance` is the irradiance on a surface that faces the light: a diffuse surface of albedo a that faces it shows
/// a radiance of a / pi times it.
///
///     direction   vector   points TOWARDS the light, any length but 0                     (required)
///     radiance    color    irradiance perpendicular to the direction, in W / m^2          (default 1)
///
///         <emitter type="directional">
///             <vector name="direction" value="1 2 0.5"/>
///             <color name="radiance" value="3 3 2.8"/>
///         </emitter>
class DirectionalEmitter final : public Emitter {
public:
    explicit DirectionalEmitter(const Params& params) : irradiance_(params.color("radiance", Color(1.f)))
    {
        const Vec3f direction = params.vector("direction", Vec3f(0.f));
        if (max_component(abs(direction)) > 0.f)
            direction_ = normalize(direction);
        else
            params.fail("direction", params.has("direction") ? "must not be 0: it points towards the light"
                                                             : "must be given: it points towards the light");
    }

    void prepare(const SceneSphere& sphere) override
    {
        scene_radius_ = sphere.radius > 0.f ? sphere.radius : 1.f;
    }

    std::optional<EmitterSample> sample(const LightReceiver& receiver, double /*u_select*/,
                                        const Vec2f& /*u*/, Measure /*measure*/) const override
    {
        if (!receiver.counts_light_from(direction_)) return std::nullopt;
        EmitterSample sample;
        sample.wi = direction_;
        sample.distance = infinity;
        sample.position = Vec3f(0.f);
        sample.radiance = irradiance_;
        sample.pdf = 1.f;
        sample.is_delta = true;
        return sample;
    }

    EmitterValue evaluate(const Vec3f&, const Vec3f&, const SurfacePoint*, Measure) const override
    {
        return {};
    }

    // What passes through the disk that the scene's sphere fills, seen from the light.
    float power() const override { return pi * sqr(scene_radius_) * luminance(irradiance_); }
    bool is_delta() const override { return true; }
    bool is_infinite() const override { return true; }

private:
    Color irradiance_;
    Vec3f direction_{0.f, 0.f, 1.f};
    float scene_radius_ = 1.f;
};

template std::unique_ptr<Emitter> build<DirectionalEmitter>(const Params&);

} // namespace plumb
