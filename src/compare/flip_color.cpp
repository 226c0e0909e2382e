// SPDX-License-Identifier: MIT
#include "compare/flip_color.h"

namespace plumb::flip {

namespace {

// XYZ of the sRGB primaries as exact fractions: they follow from the chromaticities of IEC 61966-2-1.
constexpr double x_weights[3] = {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0};
constexpr double y_weights[3] = {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0};
constexpr double z_weights[3] = {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0};

double weigh(const double (&weights)[3], const Vec3d& rgb)
{
    return weights[0] * rgb.x + weights[1] * rgb.y + weights[2] * rgb.z;
}

// XYZ as a fraction of white, which is linear RGB (1, 1, 1).
Vec3d relative_xyz(const Vec3d& rgb)
{
    const Vec3d one(1.0);
    return {weigh(x_weights, rgb) / weigh(x_weights, one), weigh(y_weights, rgb) / weigh(y_weights, one),
            weigh(z_weights, rgb) / weigh(z_weights, one)};
}

// The inverse, by Cramer's rule.
Vec3d linear_from_relative_xyz(const Vec3d& relative)
{
    const Vec3d one(1.0);
    const Vec3d rows[3] = {Vec3d(x_weights[0], x_weights[1], x_weights[2]) / weigh(x_weights, one),
                           Vec3d(y_weights[0], y_weights[1], y_weights[2]) / weigh(y_weights, one),
                           Vec3d(z_weights[0], z_weights[1], z_weights[2]) / weigh(z_weights, one)};
    const Vec3d yz = cross(rows[1], rows[2]);
    const Vec3d zx = cross(rows[2], rows[0]);
    const Vec3d xy = cross(rows[0], rows[1]);
    return (yz * relative.x + zx * relative.y + xy * relative.z) * (1.0 / dot(rows[0], yz));
}

double lab_curve(double x)
{
    constexpr double delta = 6.0 / 29.0;
    if (x > delta * delta * delta) return power(x, 1.0 / 3.0);
    return x / (3.0 * delta * delta) + 4.0 / 29.0;
}

} // namespace

double power(double base, double exponent)
{
    return base > 0.0 ? exp(exponent * log(base)) : 0.0;
}

Vec3d ycxcz_from_linear(const Vec3d& rgb)
{
    const Vec3d xyz = relative_xyz(rgb);
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

Vec3d linear_from_ycxcz(const Vec3d& ycxcz)
{
    const double y = (ycxcz.x + 16.0) / 116.0;
    return linear_from_relative_xyz({ycxcz.y / 500.0 + y, y, y - ycxcz.z / 200.0});
}

Vec3d hunt_lab_from_linear(const Vec3d& rgb)
{
    const Vec3d xyz = relative_xyz(rgb);
    const Vec3d curved(lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z));
    const double lightness = 116.0 * curved.y - 16.0;
    const double hunt = 0.01 * lightness;
    return {lightness, hunt * 500.0 * (curved.x - curved.y), hunt * 200.0 * (curved.y - curved.z)};
}

double hyab(const Vec3d& a, const Vec3d& b)
{
    const Vec3d d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

} // namespace plumb::flip
