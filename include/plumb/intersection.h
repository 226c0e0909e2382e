// SPDX-License-Identifier: MIT
#pragma once

// Where a ray meets a triangle or a sphere, in our own double-precision arithmetic.
//
// Embree finds which primitive a ray meets; these say where, with the same bits on every machine.

#include "plumb/ray.h"

#include <array>
#include <optional>

namespace plumb {

// Barycentric coordinates of the point where the ray meets the plane of the triangle, moved into the triangle if
// rounding left them outside: position = (1 - u - v) p0 + u p1 + v p2. Moeller and Trumbore 1997, equation 4.
struct Barycentric {
    double u = 0.0;
    double v = 0.0;
};
Barycentric intersect_triangle(const Ray& ray, const Vec3f& p0, const Vec3f& p1, const Vec3f& p2);

// The smallest t with t_min < t < t_max at which the ray meets the sphere from outside or inside.
std::optional<double> intersect_sphere(const Ray& ray, const Vec3f& center, float radius);

} // namespace plumb
