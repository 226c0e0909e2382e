// SPDX-License-Identifier: MIT

// The quadratic is solved as in Haines, Guenther and Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere
// Intersection", Ray Tracing Gems, chapter 7, equations 5, 10 and 11, in the plane across the axis.

#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/shape.h"
#include "plumb/sampling/sampling.h"
#include "shapes/triangle.h"
#include "shapes/width_axis.h"

#include <utility>

#include <fmt/format.h>

namespace plumb {

/// The side of a cylinder, without its ends, intersected exactly (not as triangles). Its front side is the outside.
///
/// uv: u is the angle divided by 2 pi, counted counter-clockwise as seen from p1, v runs from 0 at p0 to 1 at p1. The angle
/// starts where the x axis turns to when the z axis is turned to that of the cylinder by the shortest way.
///
///     p0            point       the middle of one end                                     (default 0 0 0)
///     p1            point       the middle of the other                                   (default 0 0 1)
///     radius        float       greater than 0                                            (default 1)
///     toWorld       transform   moves, turns, mirrors or scales; across the axis evenly   (default: the identity)
///     flipNormals   boolean     make the inside the front side                            (default false)
///
///         <shape type="cylinder">
///             <point name="p1" value="0 2 0"/>
///             <float name="radius" value="0.25"/>
///         </shape>
class Cylinder final : public Shape, private Primitives {
public:
    explicit Cylinder(const Params& params)
    {
        const Vec3d p0(params.point("p0", Vec3f(0.f)));
        const Vec3d p1(params.point("p1", Vec3f(0.f, 0.f, 1.f)));
        const double radius = params.number("radius", 1.f, Range::positive());
        const Transform to_world = params.transform("toWorld");
        side_ = params.boolean("flipNormals", false) ? -1.f : 1.f;
        if (p0 == p1) {
            params.fail("p1", "must differ from p0: the axis runs from there to here");
            return;
        }
        const Vec3d axis = normalize(p1 - p0);
        const auto [x, y] = axes_across(axis);
        base_ = to_world.point(p0);
        axis_ = to_world.vector(p1 - p0);
        x_ = to_world.vector(x * radius);
        y_ = to_world.vector(y * radius);
        length_ = length(axis_);
        radius_ = length(x_);
        area_ = static_cast<float>(2.0 * pi_d * radius_ * length_);
        if (!(area_ > 0.f) || !std::isfinite(1.f / area_) || !std::isfinite(area_) ||
            !is_finite(bounds().min) || !is_finite(bounds().max)) {
            params.fail(
                params.has("toWorld") ? "toWorld" : "radius",
                fmt::format("gives the cylinder area {:.6g}: its points and its area must be numbers that a "
                            "float can hold, and the area positive; scale the scene",
                            2.0 * pi_d * radius_ * length_));
            return;
        }
        if (!is_circular()) {
            params.fail("toWorld", "makes the cylinder oblique or its cross-section an ellipse; use a mesh");
            return;
        }
        direction_ = axis_ / length_;
        x_ = x_ / radius_;
        // toWorld may mirror: then the angle runs the other way round.
        const double handed = dot(cross(axis_, x_), y_) < 0.0 ? -1.0 : 1.0;
        y_ = cross(direction_, x_) * handed;
        end_margin_ = std::min(edge_clearance(largest_coordinate(bounds())) / length_, 0.5);
    }

    void add_to(AccelBuilder& builder) const override { builder.add_user(*this); }

    SurfacePoint surface_at(const Ray& ray, std::uint32_t primitive) const override
    {
        // Embree met it with the same arithmetic; should the ranges of t differ, take the point nearest to the axis.
        const double t = intersect(ray, primitive).value_or(nearest_to_axis(ray));
        const Vec3d point = Vec3d(ray.origin) + Vec3d(ray.direction) * t - base_;
        const Vec3d across = point - direction_ * dot(point, direction_);
        const double distance = length(across);
        const Vec3d out = distance > 0.0 ? across / distance : x_;

        const ShapeSample place = at(out, dot(point, direction_) / length_);
        SurfacePoint result;
        result.position = place.position;
        result.clearance = place.clearance;
        result.geometric_normal = place.normal;
        result.shading = Frame(place.normal);
        result.uv = place.uv;
        result.primitive = primitive;
        return result;
    }

    Tangents tangents(const SurfacePoint& at) const override
    {
        const SinCosD angle = sin_cos(2.0 * pi_d * static_cast<double>(at.uv.x));
        return {Vec3f((y_ * angle.cos - x_ * angle.sin) * (2.0 * pi_d * radius_)), Vec3f(axis_)};
    }

    ShapeSample sample_area(double /*u_select*/, const Vec2f& u) const override
    {
        const SinCosD angle = sin_cos(2.0 * pi_d * static_cast<double>(u.x));
        return at(x_ * angle.cos + y_ * angle.sin, u.y);
    }

    float area() const override { return area_; }

    // Of the two circles at the ends.
    Box3f bounds() const override
    {
        Box3f box;
        for (const Vec3d& end : {base_, base_ + axis_}) {
            Vec3d reach;
            for (int i = 0; i < 3; ++i)
                reach[i] = radius_ * std::sqrt(std::max(1.0 - sqr(axis_[i] / length_), 0.0));
            box.extendBy(Vec3f(end - reach));
            box.extendBy(Vec3f(end + reach));
        }
        return box;
    }

    DirectionCone normals() const override { return {}; }

private:
    std::size_t count() const override { return 1; }
    Box3f bounds(std::uint32_t) const override { return bounds(); }

    std::optional<double> intersect(const Ray& ray, std::uint32_t) const override
    {
        // Across the axis, where it is a circle.
        const Vec3d direction(ray.direction);
        const Vec3d from_base = Vec3d(ray.origin) - base_;
        const Vec3d d = direction - direction_ * dot(direction, direction_);
        const Vec3d o = from_base - direction_ * dot(from_base, direction_);
        const double a = dot(d, d);
        const double b = -dot(o, d);
        const Vec3d nearest = o + d * (b / a);
        const double discriminant = radius_ * radius_ - dot(nearest, nearest);
        if (!(discriminant >= 0.0)) return std::nullopt; // also along the axis
        const double distance = length(o);
        const double c = (distance - radius_) * (distance + radius_);
        const double q = b + std::copysign(std::sqrt(a * discriminant), b);
        const double t0 = std::min(c / q, q / a);
        const double t1 = std::max(c / q, q / a);
        const auto meets = [&](double t) {
            const double along = dot(from_base + direction * t, direction_);
            return t > static_cast<double>(ray.t_min) && t < static_cast<double>(ray.t_max) && along >= 0.0 &&
                   along <= length_;
        };
        if (meets(t0)) return t0;
        if (meets(t1)) return t1;
        return std::nullopt;
    }

    double nearest_to_axis(const Ray& ray) const
    {
        const Vec3d direction(ray.direction), from_base = Vec3d(ray.origin) - base_;
        const Vec3d d = direction - direction_ * dot(direction, direction_);
        const double a = dot(d, d);
        return a > 0.0 ? -dot(from_base, d) / a : 0.0;
    }

    // What x and y become when z is turned to the axis by the shortest way.
    static std::pair<Vec3d, Vec3d> axes_across(const Vec3d& axis)
    {
        if (axis.z < -1.0 + 1e-9) return {Vec3d(1.0, 0.0, 0.0), Vec3d(0.0, -1.0, 0.0)};
        const double a = 1.0 / (1.0 + axis.z);
        const Vec3d x(1.0 - axis.x * axis.x * a, -axis.x * axis.y * a, -axis.x);
        return {normalize(x), normalize(cross(axis, x))};
    }

    bool is_circular() const
    {
        constexpr double tolerance = 1e-5;
        const double ratio = length(y_) / radius_;
        return std::abs(ratio - 1.0) < tolerance && std::abs(dot(x_, y_)) < tolerance * sqr(radius_) &&
               std::abs(dot(x_, axis_)) < tolerance * radius_ * length_ &&
               std::abs(dot(y_, axis_)) < tolerance * radius_ * length_;
    }

    // The point in the direction `out` (of unit length) from the axis, at part `along` of it. Points keep away from the
    // ends: see edge_clearance().
    ShapeSample at(const Vec3d& out, double along) const
    {
        const double inside = std::clamp(along, end_margin_, 1.0 - end_margin_);
        ShapeSample sample;
        sample.position = Vec3f(base_ + axis_ * inside + out * radius_);
        sample.normal = Vec3f(out) * side_;
        sample.clearance = clearance_at(sample.position, sample.normal);
        sample.pdf = 1.f / area_;
        const double turn = atan2(dot(out, y_), dot(out, x_)) / (2.0 * pi_d);
        sample.uv = {std::min(static_cast<float>(turn < 0.0 ? turn + 1.0 : turn), one_minus_epsilon),
                     static_cast<float>(std::clamp(along, 0.0, 1.0))};
        return sample;
    }

    // It is met in double precision, so that the rounding of the position counts; and that of the normal, which is of the
    // order of the radius; and of the length, for rays nearly along the axis.
    float clearance_at(const Vec3f& p, const Vec3f& normal) const
    {
        constexpr double of_doubles = 0x1p-48;
        const double size = std::max({length_, radius_, length(base_)});
        const Vec3f error = (abs(p) * 2.f + Vec3f(static_cast<float>(radius_))) * unit_roundoff +
                            Vec3f(static_cast<float>(size * of_doubles));
        return clearance(error, abs(p), normal);
    }

    Vec3d base_{0.0};
    Vec3d axis_{0.0, 0.0, 1.0};      // from one end to the other
    Vec3d direction_{0.0, 0.0, 1.0}; // of the axis, unit length
    Vec3d x_{1.0, 0.0, 0.0};         // across the axis, unit length: where u is 0
    Vec3d y_{0.0, 1.0, 0.0};         // where u is 1/4
    double length_ = 1.0;
    double radius_ = 1.0;
    float area_ = 2.f * pi;
    float side_ = 1.f; // -1: the front is inside
    double end_margin_ = 0.0;
};

template std::unique_ptr<Shape> build<Cylinder>(const Params&);

} // namespace plumb
