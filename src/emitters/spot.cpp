// SPDX-License-Identifier: MIT

#include "emitters/aim.h"
#include "emitters/point_sample.h"
#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/emitter.h"

namespace plumb {

/// A light at a point that shines into a cone: the same in all directions up to the half-angle `beamWidth` from its axis, and
/// from there less, until nothing is left at `cutoffAngle`.
///
/// The fall-off is linear in the angle a, or "quartic": ((cos(a) - cos(cutoffAngle)) / (cos(beamWidth) -
/// cos(cutoffAngle)))^4 (Pharr, Jakob and Humphreys 2016, "Physically Based Rendering", 3rd ed., section 12.3.1).
///
/// `power` P means the intensity P / (2 pi (1 - (cos(cutoffAngle) + cos(beamWidth)) / 2)), as in that book: P is about the
/// power that the light emits.
///
/// A texture colours the cone: with (x, y, z) as in the light's own space, where it points along +z, +y is up and +x left,
/// u = (1 + x / (z tan(cutoffAngle))) / 2 and v the same of y.
///
///     position      point       where it stands                                             (default 0 0 0)
///     direction     vector      where it points, any length but 0                           (default 0 0 1)
///     target        point       instead of direction: what it points at
///     toWorld       transform   applied last                                                (default: the identity)
///     intensity     color       in W / sr inside the beam                                   (default 1)
///     power         color       instead of intensity: P, in W
///     falloff       string      between the two angles: linear or quartic                   (default linear)
///     cutoffAngle   float       half-angle of the cone in degrees, in (0, 180)              (default 20)
///     beamWidth     float       half-angle of the beam in degrees, at most cutoffAngle      (default 3/4 of cutoffAngle)
///     texture       color or texture   multiplies the intensity; cutoffAngle below 90 then  (default 1)
///
///         <emitter type="spot">
///             <point name="position" value="0 3 0"/>
///             <vector name="direction" value="0 -1 0"/>
///             <color name="intensity" value="20 20 18"/>
///             <float name="cutoffAngle" value="35"/>
///         </emitter>
class SpotEmitter final : public Emitter {
public:
    explicit SpotEmitter(const Params& params)
        : to_world_(read_aim(params)),
          to_local_(to_world_.inverse()),
          intensity_(params.color("intensity", Color(1.f))),
          is_quartic_(params.choice("falloff", "linear", {"linear", "quartic"}) == "quartic"),
          texture_(params.color_texture("texture", Color(1.f)))
    {
        const double cutoff = params.number("cutoffAngle", 20.f, Range::open(0.0, 180.0));
        const double beam =
            params.number("beamWidth", static_cast<float>(0.75 * cutoff), Range::at_least(0.0));
        if (beam > cutoff) params.fail("beamWidth", "must be at most cutoffAngle");
        is_textured_ = params.has("texture");
        if (is_textured_ && cutoff >= 90.0)
            params.fail("cutoffAngle", "must be less than 90 where a texture fills the cone");
        cutoff_ = cutoff * (pi_d / 180.0);
        beam_ = beam * (pi_d / 180.0);
        const SinCosD angle = sin_cos(cutoff_);
        tangent_ = angle.sin / angle.cos;
        cos_cutoff_ = angle.cos;
        cos_beam_ = sin_cos(beam_).cos;
        if (params.has("power")) {
            if (params.has("intensity")) params.fail("power", "cannot be given together with intensity");
            intensity_ = params.color("power", Color(1.f)) *
                         static_cast<float>(1.0 / (2.0 * pi_d * (1.0 - 0.5 * (cos_cutoff_ + cos_beam_))));
        }
        position_ = to_world_.point(Vec3d(0.0));
        axis_ = normalize(to_world_.vector(Vec3d(0.0, 0.0, 1.0)));
    }

    std::optional<EmitterSample> sample(const LightReceiver& receiver, double /*u_select*/,
                                        const Vec2f& /*u*/, Measure /*measure*/) const override
    {
        const Vec3d towards = position_ - Vec3d(receiver.position);
        const double distance2 = length_squared(towards);
        if (!(distance2 > 0.0) || !receiver.counts_light_from(Vec3f(towards))) return std::nullopt;
        const Color intensity = intensity_along(to_local_.vector(-towards));
        if (intensity.is_black()) return std::nullopt;
        return sample_of_point(Vec3f(position_), towards, distance2, intensity, 1.0 / distance2);
    }

    EmitterValue evaluate(const LightReceiver&, const Vec3f&, const SurfacePoint*, Measure) const override
    {
        return {};
    }

    // 2 pi times the integral of the fall-off times the sine; a texture counts with its mean over the square around the cone.
    float power() const override
    {
        const double edge = cutoff_ - beam_;
        const double integral = is_quartic_   ? 1.0 - cos_beam_ + 0.2 * (cos_beam_ - cos_cutoff_)
                                : edge > 1e-6 ? 1.0 - (sin_cos(cutoff_).sin - sin_cos(beam_).sin) / edge
                                              : 1.0 - cos_beam_;
        return static_cast<float>(2.0 * pi_d * integral) * luminance(intensity_ * texture_->mean());
    }

    std::optional<LightBounds> bounds() const override
    {
        const bool is_narrow = cutoff_ < 0.5 * pi_d;
        return LightBounds{Box3f(Vec3f(position_)), power(),
                           is_narrow ? cone_about(axis_, 1.0) : DirectionCone{}};
    }

    bool is_delta() const override { return true; }

private:
    // Into a direction of the light's space, of any length.
    Color intensity_along(const Vec3d& d) const
    {
        const double angle = atan2(std::sqrt(sqr(d.x) + sqr(d.y)), d.z);
        if (angle >= cutoff_) return Color(0.f);
        const double part = angle <= beam_ ? 1.0 : fall_off(angle);
        if (!is_textured_) return intensity_ * static_cast<float>(part);
        const Vec2f uv(static_cast<float>(0.5 + 0.5 * d.x / (d.z * tangent_)),
                       static_cast<float>(0.5 + 0.5 * d.y / (d.z * tangent_)));
        return intensity_ * texture_->color(uv) * static_cast<float>(part);
    }

    // Of an angle between the beam's and the cut-off.
    double fall_off(double angle) const
    {
        if (!is_quartic_) return (cutoff_ - angle) / (cutoff_ - beam_);
        return sqr(sqr((sin_cos(angle).cos - cos_cutoff_) / (cos_beam_ - cos_cutoff_)));
    }

    Transform to_world_;
    Transform to_local_;
    Color intensity_; // W / sr
    bool is_quartic_;
    std::shared_ptr<const ColorTexture> texture_;
    bool is_textured_ = false;
    double cutoff_ = 0.0; // radians
    double beam_ = 0.0;
    double tangent_ = 0.0; // of cutoff_
    double cos_cutoff_ = 0.0;
    double cos_beam_ = 0.0;
    Vec3d position_;
    Vec3d axis_;
};

template std::unique_ptr<Emitter> build<SpotEmitter>(const Params&);

} // namespace plumb
