// SPDX-License-Identifier: MIT

#include "cameras/field_of_view.h"
#include "emitters/aim.h"
#include "emitters/point_sample.h"
#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/emitter.h"

namespace plumb {

/// A slide projector without a lens: a light at a point that throws an image. A white diffuse wall across its axis at
/// distance d shows the radiance `irradiance` / d^2 everywhere inside the image, whatever the field of view: the wall's
/// irradiance is pi times that.
///
/// A perspective camera in its place, with the same parameters, sees the image upright. (u, v) of the texture are (0, 0) in
/// the image's lower left corner and (1, 1) in its upper right one, so images of textures are upright. The image is as
/// wide for its height as the image of the texture.
///
///     irradiance      color or texture   in W / m^2 at distance 1, divided by pi; at least 0   (default 1)
///     scale           float       multiplies irradiance, at least 0                            (default 1)
///     position        point       where it stands                                              (default 0 0 0)
///     direction       vector      where it points, any length but 0                            (default 0 0 1)
///     target          point       instead of direction: what it points at
///     toWorld         transform   applied last                                                 (default: the identity)
///     fov             float       field of view in degrees, in (0, 180)                        (default 30)
///     fovAxis         string      that of fov: x, y, diagonal, smaller or larger               (default x)
///     focalLengthMm   float       instead of fov: of a 36 mm x 24 mm slide's diagonal
///     flipV           boolean     v is 0 at the upper edge                                     (default false)
///
///         <emitter type="projector">
///             <point name="position" value="0 1 -2"/>
///             <texture type="imagetexture_color3f" name="irradiance">
///                 <string name="filepath" value="slide.png"/>
///             </texture>
///             <float name="scale" value="10"/>
///         </emitter>
class ProjectorEmitter final : public Emitter {
public:
    explicit ProjectorEmitter(const Params& params)
        : to_world_(read_aim(params)),
          to_local_(to_world_.inverse()),
          irradiance_(params.color_texture("irradiance", Color(1.f))),
          scale_(params.number("scale", 1.f, Range::at_least(0.0))),
          view_(read_field_of_view(params, irradiance_->resolution())),
          flip_v_(params.boolean("flipV", false))
    {
        position_ = to_world_.point(Vec3d(0.0));
        axis_ = normalize(to_world_.vector(Vec3d(0.0, 0.0, 1.0)));
        if (!to_world_.uniform_scale())
            params.fail("toWorld",
                        "stretches the projector unevenly; use fov, and an image of another shape");
    }

    std::optional<EmitterSample> sample(const LightReceiver& receiver, double /*u_select*/,
                                        const Vec2f& /*u*/, Measure /*measure*/) const override
    {
        const Vec3d towards = position_ - Vec3d(receiver.position);
        const double distance2 = length_squared(towards);
        if (!(distance2 > 0.0) || !receiver.counts_light_from(Vec3f(towards))) return std::nullopt;
        // In the plane at distance 1: left and up are positive.
        const Vec3d local = to_local_.vector(-towards);
        const double x = local.x / local.z, y = local.y / local.z;
        if (!(local.z > 0.0) || !(std::abs(x) <= view_.half_width) || !(std::abs(y) <= view_.half_height))
            return std::nullopt;
        const double v = 0.5 + 0.5 * y / view_.half_height;
        const Vec2f uv(static_cast<float>(0.5 - 0.5 * x / view_.half_width),
                       static_cast<float>(flip_v_ ? 1.0 - v : v));
        // The intensity pi irradiance / cos^3 lights a wall across the axis evenly.
        const double cosine = local.z / length(local);
        const double factor = pi_d * scale_ / (distance2 * cosine * cosine * cosine);
        const EmitterSample sample =
            sample_of_point(Vec3f(position_), towards, distance2, irradiance_->color(uv), factor);
        if (sample.radiance.is_black()) return std::nullopt;
        return sample;
    }

    EmitterValue evaluate(const LightReceiver&, const Vec3f&, const SurfacePoint*, Measure) const override
    {
        return {};
    }

    // What falls on the wall at distance 1.
    float power() const override
    {
        const double area = 4.0 * view_.half_width * view_.half_height;
        return static_cast<float>(pi_d * area) * scale_ * luminance(irradiance_->mean());
    }

    std::optional<LightBounds> bounds() const override
    {
        return LightBounds{Box3f(Vec3f(position_)), power(), cone_about(axis_, 1.0)};
    }

    bool is_delta() const override { return true; }

private:
    Transform to_world_;
    Transform to_local_;
    std::shared_ptr<const ColorTexture> irradiance_;
    float scale_;
    FieldOfView view_;
    bool flip_v_;
    Vec3d position_;
    Vec3d axis_;
};

template std::unique_ptr<Emitter> build<ProjectorEmitter>(const Params&);

} // namespace plumb
