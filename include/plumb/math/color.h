// SPDX-License-Identifier: MIT
#pragma once

// Colour: three floats of linear light with the Rec. 709 / sRGB primaries. No spectra; values above 1 are legal.

#include "plumb/math/elementary.h"
#include "plumb/math/math.h"

namespace plumb {

struct Color {
    float r = 0.f;
    float g = 0.f;
    float b = 0.f;

    constexpr Color() = default;
    constexpr explicit Color(float grey) : r(grey), g(grey), b(grey) {}
    constexpr Color(float red, float green, float blue) : r(red), g(green), b(blue) {}

    constexpr float operator[](int channel) const { return channel == 0 ? r : channel == 1 ? g : b; }

    constexpr Color& operator+=(const Color& o) { return *this = Color(r + o.r, g + o.g, b + o.b); }
    constexpr Color& operator-=(const Color& o) { return *this = Color(r - o.r, g - o.g, b - o.b); }
    constexpr Color& operator*=(const Color& o) { return *this = Color(r * o.r, g * o.g, b * o.b); }
    constexpr Color& operator*=(float s) { return *this = Color(r * s, g * s, b * s); }
    constexpr Color& operator/=(float s) { return *this = Color(r / s, g / s, b / s); }

    friend constexpr Color operator+(Color x, const Color& y) { return x += y; }
    friend constexpr Color operator-(Color x, const Color& y) { return x -= y; }
    friend constexpr Color operator*(Color x, const Color& y) { return x *= y; }
    friend constexpr Color operator*(Color a, float s) { return a *= s; }
    friend constexpr Color operator*(float s, Color a) { return a *= s; }
    friend constexpr Color operator/(Color a, float s) { return a /= s; }
    friend constexpr bool operator==(const Color&, const Color&) = default;

    constexpr bool is_black() const { return r == 0.f && g == 0.f && b == 0.f; }
};

inline bool is_finite(const Color& c)
{
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

inline float max_component(const Color& c)
{
    return std::max({c.r, c.g, c.b});
}

inline float min_component(const Color& c)
{
    return std::min({c.r, c.g, c.b});
}

// Luminance with the weights that the courses use (Rec. 709, D65).
constexpr float luminance(const Color& c)
{
    return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b;
}

// The sRGB transfer functions, IEC 61966-2-1, per channel; arguments in [0, 1].
inline float srgb_from_linear(float x)
{
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.f / 2.4f) - 0.055f;
}

inline float linear_from_srgb(float x)
{
    return x <= 0.04045f ? x / 12.92f : pow((x + 0.055f) / 1.055f, 2.4f);
}

} // namespace plumb
