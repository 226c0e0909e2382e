// SPDX-License-Identifier: MIT

// [1] Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
// [2] Haines, Guenther and Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection",
//     Ray Tracing Gems, chapter 7.

#include "plumb/intersection.h"

#include <algorithm>
#include <cmath>

namespace plumb {

Barycentric intersect_triangle(const Ray& ray, const Vec3f& p0, const Vec3f& p1, const Vec3f& p2)
{
    // [1], equation 4. Differences of floats are (nearly always) exact in double precision.
    const Vec3d direction(ray.direction);
    const Vec3d corner(p0);
    const Vec3d edge1 = Vec3d(p1) - corner;
    const Vec3d edge2 = Vec3d(p2) - corner;
    const Vec3d to_origin = Vec3d(ray.origin) - corner;
    const Vec3d p = cross(direction, edge2);
    const Vec3d q = cross(to_origin, edge1);
    const double determinant = dot(edge1, p);
    double u = dot(to_origin, p) / determinant;
    double v = dot(direction, q) / determinant;

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

std::optional<double> intersect_sphere(const Ray& ray, const Vec3f& center, float radius)
{
    const Vec3d direction(ray.direction);
    const Vec3d from_center = Vec3d(ray.origin) - Vec3d(center);
    const double r = radius;
    const double a = dot(direction, direction);
    const double b = -dot(from_center, direction);

    // [2], equation 5: the distance of the centre from the ray, without cancellation.
    const Vec3d nearest = from_center + direction * (b / a);
    const double discriminant = r * r - dot(nearest, nearest);
    if (!(discriminant >= 0.0)) return {};

    // [2], equations 10 and 11: no difference of nearly equal numbers.
    const double distance = length(from_center);
    const double c = (distance - r) * (distance + r);
    const double q = b + std::copysign(std::sqrt(a * discriminant), b);
    const double t0 = std::min(c / q, q / a);
    const double t1 = std::max(c / q, q / a);
    const auto in_range = [&ray](double t) { return t > ray.t_min && t < ray.t_max; };
    if (in_range(t0)) return t0;
    if (in_range(t1)) return t1;
    return {};
}

} // namespace plumb
