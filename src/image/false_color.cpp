// SPDX-License-Identifier: MIT
#include "plumb/image/false_color.h"

#include <algorithm>

namespace plumb {

namespace {

// The most colourful helix of this kind that stays inside sRGB, but for a little room.
constexpr double darkest = 0.21, lightest = 0.95;
constexpr double chroma = 0.1;
constexpr double degree = 0x1.1df46a2529d39p-6; // pi / 180
constexpr double first_hue = 320.0 * degree, last_hue = 105.0 * degree;

double cube(double x)
{
    return x * x * x;
}

} // namespace

Oklab false_color_in_oklab(double t)
{
    t = std::clamp(t, 0.0, 1.0);
    const SinCosD hue = sin_cos(first_hue + (last_hue - first_hue) * t);
    return {darkest + (lightest - darkest) * t, chroma * hue.cos, chroma * hue.sin};
}

Vec3d linear_srgb(const Oklab& color)
{
    // [1], oklab_to_linear_srgb
    const double l = cube(color.lightness + 0.3963377774 * color.a + 0.2158037573 * color.b);
    const double m = cube(color.lightness - 0.1055613458 * color.a - 0.0638541728 * color.b);
    const double s = cube(color.lightness - 0.0894841775 * color.a - 1.2914855480 * color.b);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Color false_color(double t)
{
    const Vec3d rgb = linear_srgb(false_color_in_oklab(t));
    const auto channel = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
    return {channel(rgb.x), channel(rgb.y), channel(rgb.z)};
}

} // namespace plumb
