// SPDX-License-Identifier: MIT

#include "emitters/point_sample.h"
#include "model/plugin.h"
#include "plumb/model/emitter.h"

namespace plumb {

/// A light at a point, the same in all directions.
///
/// Give `radiance`, which is the intensity I: radiance I / d^2 arrives at distance d; or `power`: I = power / (4 pi).
///
///     position   point   where it stands              (default 0 0 0)
///     radiance   color   intensity in W / sr          (default 1)
///     power      color   emitted power in W           (default: from radiance)
///
///         <emitter type="point">
///             <point name="position" value="0 3 0"/>
///             <color name="radiance" value="20 20 20"/>
///         </emitter>
class PointEmitter final : public Emitter {
public:
    explicit PointEmitter(const Params& params)
        : position_(params.point("position", Vec3f(0.f))), intensity_(read_intensity(params))
    {}

    std::optional<EmitterSample> sample(const LightReceiver& receiver, double /*u_select*/,
                                        const Vec2f& /*u*/, Measure /*measure*/) const override
    {
        const Vec3d towards = Vec3d(position_) - Vec3d(receiver.position);
        const double distance2 = length_squared(towards);
        if (!(distance2 > 0.0) || !receiver.counts_light_from(Vec3f(towards))) return std::nullopt;
        return sample_of_point(position_, towards, distance2, intensity_, 1.0 / distance2);
    }

    EmitterValue evaluate(const LightReceiver&, const Vec3f&, const SurfacePoint*, Measure) const override
    {
        return {};
    }

    float power() const override { return 4.f * pi * luminance(intensity_); }
    std::optional<LightBounds> bounds() const override
    {
        return LightBounds{Box3f(position_), power(), DirectionCone{}};
    }

    bool is_delta() const override { return true; }

private:
    static Color read_intensity(const Params& params)
    {
        const bool has_radiance = params.has("radiance");
        const bool has_power = params.has("power");
        const Color radiance = params.color("radiance", Color(1.f));
        const Color power = params.color("power", Color(1.f));
        if (has_radiance && has_power)
            params.fail("power",
                        "and radiance were both given: power is 4 pi times radiance, so keep one of them");
        return has_power ? power / (4.f * pi) : radiance;
    }

    Vec3f position_;
    Color intensity_; // W / sr
};

template std::unique_ptr<Emitter> build<PointEmitter>(const Params&);

} // namespace plumb
