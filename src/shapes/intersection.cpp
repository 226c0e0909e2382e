// SPDX-License-Identifier: MIT

// [1] Haines, Guenther and Akenine-Moeller 2019, "Precision Improvements for Ray/Sphere Intersection",
//     Ray Tracing Gems, chapter 7.

#include "shapes/intersection.h"

#include <algorithm>
#include <cmath>

namespace plumb {

namespace {

// from_center: to the ray's origin.
inline std::optional<double> meet_sphere(const Vec3d& from_center, const Vec3d& direction, double r,
                                         double t_min, double t_max)
{
    const double a = dot(direction, direction);
    const double b = -dot(from_center, direction);

    // [1], equation 5: the distance of the centre from the ray, without cancellation.
    const Vec3d nearest = from_center + direction * (b / a);
    const double discriminant = r * r - dot(nearest, nearest);
    if (!(discriminant >= 0.0)) return {};

    // [1], equations 10 and 11: no difference of nearly equal numbers.
    const double distance = length(from_center);
    const double c = (distance - r) * (distance + r);
    const double q = b + std::copysign(std::sqrt(a * discriminant), b);
    const double t0 = std::min(c / q, q / a);
    const double t1 = std::max(c / q, q / a);
    const auto in_range = [=](double t) { return t > t_min && t < t_max; };
    if (in_range(t0)) return t0;
    if (in_range(t1)) return t1;
    return {};
}

} // namespace

std::optional<double> intersect_sphere(const Ray& ray, const Vec3f& center, float radius)
{
    return meet_sphere(Vec3d(ray.origin) - Vec3d(center), Vec3d(ray.direction), radius, ray.t_min, ray.t_max);
}

std::optional<double> intersect_sphere(const RayD& ray, const Vec3f& center, float radius)
{
    return meet_sphere(ray.origin - Vec3d(center), ray.direction, radius, ray.t_min, ray.t_max);
}

} // namespace plumb
