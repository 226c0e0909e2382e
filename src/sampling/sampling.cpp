// SPDX-License-Identifier: MIT

// [1] Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square", Journal of Graphics Tools 2(3).

#include "plumb/sampling/sampling.h"

#include "math/series.h"

namespace plumb {

namespace {

constexpr float quarter_pi = pi / 4.f;

// A point of the unit disk; the radius is not squeezed through x and y, so that 1 - radius keeps its digits.
struct DiskPoint {
    float x;
    float y;
    float radius; // in [0, 1]
};

DiskPoint concentric_disk(const Vec2f& u)
{
    // [1]: each quarter of the square becomes a quarter of the disk, squares about the centre become circles. A
    // negative radius turns the opposite quarter's angles by pi.
    const float a = 2.f * u.x - 1.f;
    const float b = 2.f * u.y - 1.f;
    if (a == 0.f && b == 0.f) return {0.f, 0.f, 0.f};
    const bool wide = std::abs(a) > std::abs(b);
    const float radius = select(wide, a, b);
    const SinCos angle =
        sin_cos_in_first_octant(quarter_pi * (select(wide, b, a) / radius)); // from the nearer axis
    const float along = radius * angle.cos;
    const float across = radius * angle.sin;
    return {select(wide, along, across), select(wide, across, along), std::abs(radius)};
}

Vec3f direction(float sine, float cosine, float u)
{
    const SinCos phi = sin_cos(two_pi * u);
    return {sine * phi.cos, sine * phi.sin, cosine};
}

} // namespace

Vec2f square_to_concentric_disk(const Vec2f& u)
{
    const DiskPoint p = concentric_disk(u);
    return {p.x, p.y};
}

float concentric_disk_pdf(const Vec2f& p)
{
    return sqr(p.x) + sqr(p.y) <= 1.f ? inv_pi : 0.f;
}

Vec3f square_to_cosine_hemisphere(const Vec2f& u)
{
    const DiskPoint p = concentric_disk(u);
    return {p.x, p.y, std::sqrt((1.f - p.radius) * (1.f + p.radius))};
}

Vec3f square_to_uniform_hemisphere(const Vec2f& u)
{
    return direction(std::sqrt(u.x * (2.f - u.x)), 1.f - u.x, u.y);
}

float uniform_hemisphere_pdf(const Vec3f& w)
{
    return w.z > 0.f ? inv_two_pi : 0.f;
}

Vec3f square_to_uniform_sphere(const Vec2f& u)
{
    return direction(2.f * std::sqrt(u.x * (1.f - u.x)), 1.f - 2.f * u.x, u.y);
}

float uniform_sphere_pdf()
{
    return 0.25f * inv_pi;
}

Vec3f square_to_uniform_cone(const Vec2f& u, float one_minus_cos)
{
    const float height = u.x * one_minus_cos;
    return direction(std::sqrt(height * (2.f - height)), 1.f - height, u.y);
}

float uniform_cone_pdf(float one_minus_cos)
{
    return inv_two_pi / one_minus_cos;
}

Vec2f square_to_triangle(const Vec2f& u)
{
    const float root = std::sqrt(1.f - u.x);
    return {1.f - root, u.y * root};
}

Vec3f square_to_cosine_power(const Vec2f& u, float exponent)
{
    // cos = (1 - u)^(1 / (exponent + 1)), in double precision: 1 - cos is small for large exponents.
    const double cosine = exp(log(1.0 - static_cast<double>(u.x)) / (static_cast<double>(exponent) + 1.0));
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    return direction(static_cast<float>(sine), static_cast<float>(cosine), u.y);
}

float cosine_power_pdf(const Vec3f& w, float exponent)
{
    // The cosine of the direction that the rounded components point to, to double precision.
    const Vec3d d(w);
    if (!(d.z > 0.0)) return 0.f;
    const double n = exponent;
    const double log_cosine = log(d.z / length(d));
    return static_cast<float>((n + 1.0) / (2.0 * pi_d) * exp(n * log_cosine));
}

} // namespace plumb
