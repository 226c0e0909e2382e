// SPDX-License-Identifier: MIT

#include "base/emplace_with.h"
#include "model/plugin.h"
#include "plumb/model/emitter.h"
#include "plumb/model/shape.h"

namespace plumb {

/// A surface that emits light: the same radiance in every direction on the front side of its shape, none behind.
///
/// The front side is that of the geometric normal, which is on the side of the vertex normals where a mesh has
/// them. Spheres are sampled by the solid angle that they subtend; so are rectangles, and meshes of two triangles that
/// make a rectangle, from nearer than their diagonal is long. Of other meshes a triangle is chosen by what it is expected
/// to send to the place that is lit, and a point uniformly over its area; all else is sampled uniformly over its area.
/// Stands inside the mesh or shape that emits.
///
///     radiance   color or texture   in W / (m^2 sr), at least 0; negative values of a texture count as 0
///                                   (default 1)
///     scale      float              multiplies radiance           (default 1)
///
///         <shape type="sphere">
///             <emitter type="area">
///                 <color name="radiance" value="15 15 12"/>
///             </emitter>
///         </shape>
class AreaEmitter final : public Emitter {
public:
    explicit AreaEmitter(const Params& params)
        : radiance_(read_radiance(params)),
          has_negative_(radiance_->min_value() < 0.f),
          scale_(params.number("scale", 1.f, Range::at_least(0.0))),
          shape_(params.parent_shape())
    {
        if (radiance_->reads_attributes()) params.fail("radiance", "cannot be an attribute of a mesh");
        if (shape_ == nullptr) {
            params.fail("area", "emitters need a surface: put it inside a <mesh> or <shape>");
        } else {
            has_solid_angle_ = shape_->has_solid_angle();
            has_parts_ = shape_->has_parts();
        }
    }

    std::optional<EmitterSample> sample(const LightReceiver& receiver, double u_select, const Vec2f& u,
                                        Measure measure) const override
    {
        if (measure != Measure::area && has_solid_angle_)
            if (const std::optional<ShapeSample> point = shape_->sample_solid_angle(receiver.position, u))
                return seen(receiver, *point, Measure::solid_angle);
        if (measure == Measure::best && has_parts_) {
            const std::optional<ShapeSample> point = shape_->sample_for(receiver, u_select, u);
            return point ? seen(receiver, *point, Measure::area) : std::nullopt;
        }
        return seen(receiver, shape_->sample_area(u_select, u), Measure::area);
    }

    EmitterValue evaluate(const LightReceiver& receiver, const Vec3f& wi, const SurfacePoint* at,
                          Measure measure) const override
    {
        if (at == nullptr) return {};
        const Vec3d direction(wi);
        const double cosine = -dot(direction, Vec3d(at->geometric_normal));
        if (!(cosine > 0.0)) return {};
        const Color radiance = radiance_of(radiance_->color(*at));
        if (measure != Measure::area && has_solid_angle_)
            if (const std::optional<float> pdf = shape_->solid_angle_pdf(receiver.position))
                return {radiance, *pdf};
        const double distance2 = length_squared(Vec3d(at->position) - Vec3d(receiver.position));
        if (measure == Measure::best && has_parts_)
            return {radiance,
                    static_cast<float>(shape_->pdf_for(receiver, at->primitive) * (distance2 / cosine))};
        return {radiance, static_cast<float>(distance2 / (cosine * shape_->area()))};
    }

    // Radiance is the same in all directions: pi times its mean leaves each unit of area.
    float power() const override
    {
        float mean = luminance(radiance_->mean() * scale_);
        // What is negative has not been left out of the mean.
        if (has_negative_) mean = std::max(mean, 1e-3f * std::max(radiance_->max_value(), 0.f) * scale_);
        return pi * shape_->area() * mean;
    }

    std::optional<LightBounds> bounds() const override
    {
        return LightBounds{shape_->bounds(), power(), shape_->normals()};
    }

    bool has_solid_angle() const override { return has_solid_angle_; }

private:
    static std::shared_ptr<const ColorTexture> read_radiance(const Params& params)
    {
        const Color fallback(1.f);
        const auto texture = params.color_texture("radiance", fallback, Range::any());
        if (!(texture->min_value() < 0.f)) return texture;
        // A colour that someone has written is a mistake; images often have a few such pixels.
        if (dynamic_cast<const UniformTexture*>(texture.get()))
            return params.color_texture("radiance", fallback);
        params.warn("radiance", "the texture has negative values, which count as 0");
        return texture;
    }

    Color radiance_of(const Color& value) const
    {
        const Color radiance = value * scale_;
        if (!has_negative_) [[likely]]
            return radiance;
        return {std::max(radiance.r, 0.f), std::max(radiance.g, 0.f), std::max(radiance.b, 0.f)};
    }

    // A point on the shape as the receiver sees it; nothing from behind. measure: of the point's density.
    std::optional<EmitterSample> seen(const LightReceiver& receiver, const ShapeSample& point,
                                      Measure measure) const
    {
        const Vec3d towards = Vec3d(point.position) - Vec3d(receiver.position);
        const double facing = -dot(towards, Vec3d(point.normal)); // the distance times the cosine there
        if (!(facing > 0.0) || !receiver.counts_light_from(Vec3f(towards))) return std::nullopt;
        return emplace_with([&] {
            const double distance2 = length_squared(towards);
            const double distance = std::sqrt(distance2);
            EmitterSample light;
            light.wi = Vec3f(towards * (1.0 / distance));
            light.distance = static_cast<float>(distance);
            light.position = point.position;
            light.normal = point.normal;
            light.clearance = point.clearance;
            light.radiance = radiance_of(radiance_->color(point.uv));
            // Per unit solid angle = per unit area * distance^2 / cosine.
            light.pdf = measure == Measure::area
                            ? static_cast<float>(point.pdf * (distance2 * distance / facing))
                            : point.pdf;
            return light;
        });
    }

    std::shared_ptr<const ColorTexture> radiance_;
    bool has_negative_;
    float scale_;
    const Shape* shape_;
    bool has_solid_angle_ = false;
    bool has_parts_ = false;
};

template std::unique_ptr<Emitter> build<AreaEmitter>(const Params&);

} // namespace plumb
