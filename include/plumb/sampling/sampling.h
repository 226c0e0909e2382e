// SPDX-License-Identifier: MIT
#pragma once

// Warps of uniform random numbers, each beside its density.
//
// Conventions. Random numbers lie in [0, 1). Directions are unit vectors in a local frame with z as the axis.
// Densities are per unit area (disk, triangle) or per unit solid angle (hemisphere, sphere, cone); a density takes
// the warped point and is 0 where the warp cannot reach.

#include "plumb/math/math.h"

namespace plumb {

Vec2f square_to_concentric_disk(const Vec2f& u); // Shirley and Chiu 1997; unit disk
float concentric_disk_pdf(const Vec2f& p);

Vec3f square_to_cosine_hemisphere(const Vec2f& u); // Malley's method over the concentric disk
inline float cosine_hemisphere_pdf(const Vec3f& w)
{
    return std::max(w.z, 0.f) * inv_pi;
}

Vec3f square_to_uniform_hemisphere(const Vec2f& u);
float uniform_hemisphere_pdf(const Vec3f& w);

Vec3f square_to_uniform_sphere(const Vec2f& u);
float uniform_sphere_pdf();

// Directions within the angle whose cosine is 1 - one_minus_cos of +z. Taking 1 - cos keeps tiny cones exact.
Vec3f square_to_uniform_cone(const Vec2f& u, float one_minus_cos);
float uniform_cone_pdf(float one_minus_cos);
// From the squared sine of an angle below 90 degrees.
inline float one_minus_cos_of(float sine_squared)
{
    return sine_squared / (1.f + std::sqrt(1.f - sine_squared));
}

// Barycentric coordinates of the second and third vertex: (1 - sqrt(1 - u.x), u.y sqrt(1 - u.x)), uniform in the
// triangle's area.
Vec2f square_to_triangle(const Vec2f& u);

// cos^exponent(theta) lobe about +z, density (exponent + 1) / (2 pi) cos^exponent(theta).
Vec3f square_to_cosine_power(const Vec2f& u, float exponent);
float cosine_power_pdf(const Vec3f& w, float exponent);

// Multiple importance sampling, Veach 1997, section 9.2, one sample of each technique: the weight of the technique
// with density `mine`. Written with the ratio, so that squares of large densities cannot overflow.
inline float balance_heuristic(float mine, float other)
{
    return mine > 0.f ? 1.f / (1.f + other / mine) : 0.f;
}

inline float power_heuristic(float mine, float other)
{
    return mine > 0.f ? 1.f / (1.f + sqr(other / mine)) : 0.f;
}

} // namespace plumb
