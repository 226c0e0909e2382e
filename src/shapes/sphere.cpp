// SPDX-License-Identifier: MIT

// [1] Pharr, Jakob and Humphreys 2023, Physically Based Rendering, 4th edition, section 6.2.4.

#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/shape.h"
#include "plumb/sampling/sampling.h"
#include "shapes/intersection.h"

#include <utility>

#include <fmt/format.h>

namespace plumb {

/// A sphere, intersected exactly (not as triangles). Its front side is the outside.
///
/// uv: u = 1 - phi / (2 pi) with phi = atan2(y, x) in [0, 2 pi), v = acos(z) / pi, of the direction (x, y, z) from
/// the centre before toWorld turns it.
///
///     center    point       the middle                                              (default 0 0 0)
///     radius    float       greater than 0                                          (default 1)
///     toWorld   transform   moves, turns, mirrors or scales evenly on all axes      (default: the identity)
///     flipNormals   boolean   make the inside the front side                        (default false)
///     flipU         boolean   u = phi / (2 pi)                                      (default false)
///
///         <shape type="sphere">
///             <point name="center" value="0 1 0"/>
///             <float name="radius" value="0.5"/>
///         </shape>
class Sphere final : public Shape, private Primitives {
public:
    explicit Sphere(const Params& params)
    {
        const Vec3f center = params.point("center", Vec3f(0.f));
        const float radius = params.number("radius", 1.f, Range::positive());
        const Transform to_world = params.transform("toWorld");
        side_ = params.boolean("flipNormals", false) ? -1.f : 1.f;
        flip_u_ = params.boolean("flipU", false);
        const std::optional<double> scale = to_world.uniform_scale();
        if (!scale) {
            params.fail("toWorld", "scales a sphere unevenly, which makes an ellipsoid of it; use a mesh");
            return;
        }
        center_ = to_world.point(center);
        radius_ = static_cast<float>(radius * *scale);
        given_radius_ = radius;
        area_ = 4.f * pi * sqr(radius_);
        to_object_ = to_world.inverse();
        if (!is_finite(center_) || !std::isfinite(area_) || !std::isfinite(1.f / area_))
            params.fail(
                params.has("toWorld") ? "toWorld" : "radius",
                fmt::format(
                    "gives the sphere radius {:.6g}: its centre and area must be numbers that a float "
                    "can hold; scale the scene",
                    radius_));
    }

    void add_to(AccelBuilder& builder) const override { builder.add_user(*this); }

    SurfacePoint surface_at(const RayD& ray, std::uint32_t primitive) const override
    {
        // Embree met this sphere with the same arithmetic; should the ranges of t differ, take the nearest point.
        const Vec3d& direction = ray.direction;
        const Vec3d origin = ray.origin - Vec3d(center_);
        const double t = intersect_sphere(ray, center_, radius_)
                             .value_or(-dot(origin, direction) / dot(direction, direction));
        const Vec3d normal = normalize(origin + direction * t);

        SurfacePoint at;
        const Vec3f out(normal);
        at.geometric_normal = out * side_;
        at.position = position(normal);
        at.clearance = clearance_at(at.position, out);
        at.shading = Frame(at.geometric_normal);
        at.uv = uv(out);
        at.primitive = primitive;
        return at;
    }

    Tangents tangents(const SurfacePoint& at) const override
    {
        const Vec3f d = normalize(to_object_.vector(at.geometric_normal * side_));
        const float ring = std::sqrt(sqr(d.x) + sqr(d.y));
        const Vec3f by_u = Vec3f(d.y, -d.x, 0.f) * (flip_u_ ? -two_pi : two_pi);
        const Vec3f by_v = Vec3f(d.x * d.z / ring, d.y * d.z / ring, -ring) * pi;
        const Transform to_world = to_object_.inverse();
        if (!(ring > 0.f))
            return {to_world.vector(Vec3f(0.f, d.z, 0.f)), to_world.vector(Vec3f(1.f, 0.f, 0.f))};
        return {to_world.vector(by_u) * given_radius_, to_world.vector(by_v) * given_radius_};
    }

    ShapeSample sample_area(double /*u_select*/, const Vec2f& u) const override
    {
        return sample_at(normalize(Vec3d(square_to_uniform_sphere(u))), 1.f / area_);
    }

    std::optional<ShapeSample> sample_solid_angle(const Vec3f& from, const Vec2f& u) const override
    {
        const std::optional<Cone> cone = cone_from(from);
        if (!cone) return std::nullopt;

        // A direction uniform in the cone, as 1 - cos(theta) and the two components of sin(theta).
        const Vec2f p = square_to_concentric_disk(u);
        const double r2 = std::min(sqr<double>(p.x) + sqr<double>(p.y), 1.0);
        const double one_minus_cos = r2 * cone->one_minus_cos;
        const double sin2 = one_minus_cos * (2.0 - one_minus_cos);

        // The angle alpha at the centre, between the receiver and the point met: [1], equation 6.20.
        const double inside = std::sqrt(std::max(1.0 - sin2 / sqr(cone->sin_max), 0.0));
        const double cos_alpha = sin2 / cone->sin_max + (1.0 - one_minus_cos) * inside;
        const double sin_alpha = std::sqrt(std::max((1.0 - cos_alpha) * (1.0 + cos_alpha), 0.0));
        const double scale = r2 > 0.0 ? sin_alpha / std::sqrt(r2) : 0.0;
        const auto [s, t] = basis_about(cone->axis);
        const Vec3d normal = s * (p.x * scale) + t * (p.y * scale) - cone->axis * cos_alpha;
        return sample_at(normalize(normal), cone->pdf);
    }

    std::optional<float> solid_angle_pdf(const Vec3f& from) const override
    {
        const std::optional<Cone> cone = cone_from(from);
        if (!cone) return std::nullopt;
        return cone->pdf;
    }

    bool has_solid_angle() const override { return true; }
    float area() const override { return area_; }
    Box3f bounds() const override { return {center_ - Vec3f(radius_), center_ + Vec3f(radius_)}; }
    DirectionCone normals() const override { return {}; }
    std::optional<Ball> as_ball() const override { return Ball{center_, radius_}; }

private:
    std::size_t count() const override { return 1; }
    Box3f bounds(std::uint32_t) const override { return bounds(); }
    std::optional<double> intersect(const Ray& ray, std::uint32_t) const override
    {
        return intersect_sphere(ray, center_, radius_);
    }

    // The directions in which the sphere is seen from outside.
    struct Cone {
        Vec3d axis; // towards the centre
        double sin_max;
        double one_minus_cos;
        float pdf; // per unit solid angle, finite
    };

    std::optional<Cone> cone_from(const Vec3f& from) const
    {
        // What shines inwards does not light the outside; and points on it may be outside by rounding.
        if (side_ < 0.f) return std::nullopt;
        const Vec3d to_center = Vec3d(center_) - Vec3d(from);
        const double distance = length(to_center);
        const double r = radius_;
        if (!(distance > r)) return std::nullopt;

        // No difference of nearly equal numbers, whether the sphere is tiny or the receiver nearly touches it.
        const double sin_max = r / distance;
        const double cos_max = std::sqrt((distance - r) * (distance + r)) / distance;
        const double one_minus_cos = sqr(sin_max) / (1.0 + cos_max);
        const auto pdf = static_cast<float>(1.0 / (2.0 * pi_d * one_minus_cos));
        if (!std::isfinite(pdf)) return std::nullopt;
        return Cone{to_center / distance, sin_max, one_minus_cos, pdf};
    }

    // Two vectors that make an orthonormal basis with a unit vector: as Frame, in double precision.
    static std::pair<Vec3d, Vec3d> basis_about(const Vec3d& n)
    {
        const double sign = std::copysign(1.0, n.z);
        const double a = -1.0 / (sign + n.z);
        const double b = n.x * n.y * a;
        return {Vec3d(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
                Vec3d(b, sign + n.y * n.y * a, -n.y)};
    }

    Vec3f position(const Vec3d& normal) const
    {
        return Vec3f(Vec3d(center_) + normal * static_cast<double>(radius_));
    }

    // The sphere is met in double precision, so that only the rounding of the position counts; and that of the
    // normal, which is of the order of the radius.
    float clearance_at(const Vec3f& p, const Vec3f& normal) const
    {
        const Vec3f error = (abs(p) * 2.f + Vec3f(radius_)) * unit_roundoff;
        return clearance(error, abs(p), normal);
    }

    Vec2f uv(const Vec3f& normal) const
    {
        const Vec3f d = normalize(to_object_.vector(normal));
        const float phi = atan2(d.y, d.x);
        const float turn = (phi < 0.f ? phi + two_pi : phi) * inv_two_pi;
        return {flip_u_ ? std::min(turn, one_minus_epsilon) : 1.f - std::min(turn, 1.f), acos(d.z) * inv_pi};
    }

    ShapeSample sample_at(const Vec3d& normal, float pdf) const
    {
        const Vec3f p = position(normal);
        const Vec3f n(normal);
        return {p, clearance_at(p, n), n * side_, pdf, uv(n)};
    }

    Vec3f center_{0.f};
    float radius_ = 1.f;
    float given_radius_ = 1.f; // before toWorld
    float area_ = 4.f * pi;
    float side_ = 1.f; // -1: the front is inside
    bool flip_u_ = false;
    Transform to_object_;
};

template std::unique_ptr<Shape> build<Sphere>(const Params&);

} // namespace plumb
