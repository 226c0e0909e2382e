// SPDX-License-Identifier: MIT
#pragma once

// Where a ray meets a triangle or a sphere, in our own double-precision arithmetic.
//
// Embree finds which primitive a ray meets; these say where, with the same bits on every machine.
//
// [1] Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1).

#include "plumb/math/ray.h"

#include <array>
#include <optional>

namespace plumb {

// A corner of a triangle and the edges from there to the others, in double precision: differences of floats are (nearly
// always) exact then.
struct TriangleEdges {
    TriangleEdges() = default;
    TriangleEdges(const Vec3f& p0, const Vec3f& p1, const Vec3f& p2)
        : corner(p0), edge1(Vec3d(p1) - corner), edge2(Vec3d(p2) - corner)
    {}

    Vec3d corner{0.0};
    Vec3d edge1{0.0};
    Vec3d edge2{0.0};
};

// Barycentric coordinates of the point where the ray meets the plane of the triangle, moved into the triangle if
// rounding left them outside: position = corner + u edge1 + v edge2.
struct Barycentric {
    double u = 0.0;
    double v = 0.0;
};
inline Barycentric intersect_triangle(const RayD& ray, const TriangleEdges& triangle)
{
    // [1], equation 4.
    const Vec3d& direction = ray.direction;
    const Vec3d to_origin = ray.origin - triangle.corner;
    const Vec3d p = cross(direction, triangle.edge2);
    const Vec3d q = cross(to_origin, triangle.edge1);
    const double scale = 1.0 / dot(triangle.edge1, p);
    double u = dot(to_origin, p) * scale;
    double v = dot(direction, q) * scale;

    // A ray in the plane of the triangle, or a triangle without area: any point of it will do.
    if (!std::isfinite(u) || !std::isfinite(v)) return {1.0 / 3.0, 1.0 / 3.0};

    u = std::max(u, 0.0);
    v = std::max(v, 0.0);
    const double sum = u + v;
    if (sum > 1.0) {
        u /= sum;
        v /= sum;
    }
    return {u, v};
}

// The smallest t with t_min < t < t_max at which the ray meets the sphere from outside or inside.
std::optional<double> intersect_sphere(const Ray& ray, const Vec3f& center, float radius);
std::optional<double> intersect_sphere(const RayD& ray, const Vec3f& center, float radius);

} // namespace plumb
