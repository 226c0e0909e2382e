// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/shape.h"
#include "plumb/sampling/sampling.h"
#include "shapes/triangle.h"
#include "shapes/width_axis.h"

#include <fmt/format.h>

namespace plumb {

/// A flat disk, intersected exactly (not as triangles); toWorld may make an ellipse of it.
///
/// The front side, which emitters shine from, is where `normal` points; toWorld is applied last, to normals by its
/// inverse transpose. uv: u is the distance from the centre divided by the radius, v the angle divided by 2 pi, counted
/// counter-clockwise as seen from the front, from the world x axis projected onto the disk's plane (from z if the normal
/// is parallel to x).
///
///     center    point       the middle                                (default 0 0 0)
///     radius    float       greater than 0                            (default 1)
///     normal    vector      any length but 0                          (default 0 0 1)
///     toWorld   transform   from these coordinates to the world       (default: the identity)
///     flipNormals   boolean   turn the front side to the back; uv stay  (default false)
///
///         <shape type="disk">
///             <point name="center" value="0 2 0"/>
///             <float name="radius" value="0.5"/>
///             <vector name="normal" value="0 -1 0"/>
///         </shape>
class Disk final : public Shape, private Primitives {
public:
    explicit Disk(const Params& params)
    {
        const Vec3d center(params.point("center", Vec3f(0.f)));
        const double radius = params.number("radius", 1.f, Range::positive());
        const Vec3f given_normal = params.vector("normal", Vec3f(0.f, 0.f, 1.f));
        const Transform to_world = params.transform("toWorld");
        const bool flip_normals = params.boolean("flipNormals", false);
        if (!(max_component(abs(given_normal)) > 0.f)) {
            params.fail("normal", "must not be 0: it says where the front side is");
            return;
        }

        const Vec3f unit_normal = normalize(given_normal);
        const Vec3d normal = normalize(Vec3d(unit_normal));
        const Vec3d along_width = width_axis(normal);
        center_ = to_world.point(center);
        axis_x_ = to_world.vector(along_width * radius);
        axis_y_ = to_world.vector(cross(normal, along_width) * radius);

        const Vec3d crossed = cross(axis_x_, axis_y_);
        const double size = length(crossed);
        area_ = static_cast<float>(pi_d * size);
        for (int i = 0; i < 3; ++i) reach_[i] = std::sqrt(sqr(axis_x_[i]) + sqr(axis_y_[i]));
        const Box3f box = bounds();
        if (!(area_ > 0.f) || !std::isfinite(1.f / area_) || !std::isfinite(area_) || !is_finite(box.min) ||
            !is_finite(box.max)) {
            params.fail(params.has("toWorld") ? "toWorld" : "radius",
                        fmt::format("gives the disk area {:.6g}: its points and its area must be numbers "
                                    "that a float can hold, and the area positive; scale the scene",
                                    pi_d * size));
            return;
        }
        plane_ = crossed / size;
        to_x_ = cross(axis_y_, plane_) / size;
        to_y_ = cross(plane_, axis_x_) / size;
        normal_ = Vec3f(plane_);
        if ((dot(normal_, to_world.normal(unit_normal)) < 0.f) != flip_normals) normal_ = -normal_;
        shading_ = Frame(normal_);
        // The short axis of an ellipse is its area by the long one, which is no longer than this.
        const double longest = std::sqrt(length_squared(axis_x_) + length_squared(axis_y_));
        largest_radius_ = 1.0 - std::min(edge_clearance(largest_coordinate(box)) * longest / size, 0.5);
    }

    void add_to(AccelBuilder& builder) const override { builder.add_user(*this); }

    SurfacePoint surface_at(const Ray& ray, std::uint32_t primitive) const override
    {
        const Vec3d origin(ray.origin), direction(ray.direction);
        const double t = dot(plane_, center_ - origin) / dot(plane_, direction);
        // A ray in the plane, which Embree's bounds may let pass: any point will do.
        const Place place = std::isfinite(t) ? place_of(origin + direction * t) : Place{0.0, 0.0};

        SurfacePoint at;
        at.position = position(place);
        at.clearance = clearance_at(at.position);
        at.geometric_normal = normal_;
        at.primitive = primitive;
        at.shading = shading_;
        at.uv = uv(place);
        return at;
    }

    Tangents tangents(const SurfacePoint& at) const override
    {
        if (!(at.uv.x > 0.f)) return {Vec3f(axis_x_), Vec3f(axis_y_)};
        const float angle = two_pi * at.uv.y;
        const double c = cos(angle), s = sin(angle);
        return {Vec3f(axis_x_ * c + axis_y_ * s),
                Vec3f((axis_y_ * c - axis_x_ * s) * (2.0 * pi_d * static_cast<double>(at.uv.x)))};
    }

    // Affine maps keep ratios of areas.
    ShapeSample sample_area(double /*u_select*/, const Vec2f& u) const override
    {
        const Vec2f p = square_to_concentric_disk(u);
        const Place place{p.x, p.y};
        const Vec3f point = position(place);
        return {point, clearance_at(point), normal_, 1.f / area_, uv(place)};
    }

    float area() const override { return area_; }

    Box3f bounds() const override { return {Vec3f(center_ - reach_), Vec3f(center_ + reach_)}; }

    DirectionCone normals() const override { return cone_about(Vec3d(normal_), 1.0); }

private:
    // A point as center + x axis_x + y axis_y; inside where x^2 + y^2 <= 1.
    struct Place {
        double x;
        double y;
    };

    std::size_t count() const override { return 1; }
    Box3f bounds(std::uint32_t) const override { return bounds(); }

    std::optional<double> intersect(const Ray& ray, std::uint32_t) const override
    {
        const Vec3d origin(ray.origin), direction(ray.direction);
        const double t = dot(plane_, center_ - origin) / dot(plane_, direction);
        if (!(t > static_cast<double>(ray.t_min) && t < static_cast<double>(ray.t_max))) return std::nullopt;
        const Place place = place_of(origin + direction * t);
        if (!(sqr(place.x) + sqr(place.y) <= 1.0)) return std::nullopt;
        return t;
    }

    Place place_of(const Vec3d& point) const
    {
        const Vec3d from_center = point - center_;
        return {dot(from_center, to_x_), dot(from_center, to_y_)};
    }

    // Points keep away from the rim: see edge_clearance().
    Vec3f position(const Place& place) const
    {
        const double radius = std::sqrt(sqr(place.x) + sqr(place.y));
        const double scale = radius > largest_radius_ ? largest_radius_ / radius : 1.0;
        return Vec3f(center_ + axis_x_ * (place.x * scale) + axis_y_ * (place.y * scale));
    }

    // The disk is met in double precision, so that the rounding of the point counts; and for rays nearly in the plane that
    // of the normal and of its product with their direction, which say on which side a ray leaves: three roundings of each
    // term, over as much as the whole disk.
    float clearance_at(const Vec3f& p) const
    {
        constexpr double of_doubles = 0x1p-50, of_sides = 2.0 * 4.0 * unit_roundoff;
        Vec3f error;
        for (int i = 0; i < 3; ++i)
            error[i] = static_cast<float>(std::abs(center_[i]) * of_doubles + reach_[i] * of_sides) +
                       std::abs(p[i]) * unit_roundoff;
        return clearance(error, abs(p), normal_);
    }

    Vec2f uv(const Place& place) const
    {
        const auto x = static_cast<float>(place.x), y = static_cast<float>(place.y);
        const float phi = atan2(y, x);
        const float turn = (phi < 0.f ? phi + two_pi : phi) * inv_two_pi;
        return {std::min(static_cast<float>(std::sqrt(sqr(place.x) + sqr(place.y))), 1.f),
                std::min(turn, one_minus_epsilon)};
    }

    Vec3d center_{0.0};
    Vec3d axis_x_{1.0, 0.0, 0.0}; // from the centre to the rim, at v = 0 and v = 1/4
    Vec3d axis_y_{0.0, 1.0, 0.0};
    Vec3d reach_{1.0, 1.0, 0.0}; // along each axis, from the centre
    Vec3d plane_{0.0, 0.0, 1.0}; // axis_x_ x axis_y_, unit length
    Vec3d to_x_{1.0, 0.0, 0.0};  // the place from the point
    Vec3d to_y_{0.0, 1.0, 0.0};
    Vec3f normal_{0.f, 0.f, 1.f};
    Frame shading_;
    float area_ = pi;
    double largest_radius_ = 1.0; // of points, as part of the radius
};

template std::unique_ptr<Shape> build<Disk>(const Params&);

} // namespace plumb
