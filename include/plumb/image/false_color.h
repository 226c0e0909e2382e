// SPDX-License-Identifier: MIT
#pragma once

// Numbers as colours: from dark purple over blue and green to light yellow, each lighter than the last.
//
// A helix in Oklab, whose lightness and hue change evenly at constant chroma: equal steps of the number are equal distances of
// that space, which is made for what eyes see.
// [1] Ottosson 2020, "A perceptual color space for image processing", https://bottosson.github.io/posts/oklab/

#include "plumb/math/color.h"

namespace plumb {

// t: from 0 to 1; clamped. Linear light.
Color false_color(double t);

inline constexpr const char* false_color_low = "dark purple";
inline constexpr const char* false_color_high = "light yellow";

// Of what has no colour: pixels that are not finite.
inline constexpr Color not_finite_color{0.f, 1.f, 0.f};

struct Oklab {
    double lightness = 0.0; // of white 1
    double a = 0.0;         // from green to red
    double b = 0.0;         // from blue to yellow
};
Oklab false_color_in_oklab(double t);
// Linear sRGB; outside 0 to 1 where that has no such colour.
Vec3d linear_srgb(const Oklab& color);

} // namespace plumb
