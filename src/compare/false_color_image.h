// SPDX-License-Identifier: MIT
#pragma once

// Maps of numbers in false colours, above a bar that tells which colour is how much.

#include "plumb/image/image.h"

#include <span>
#include <string>

namespace plumb {

// What the bar says at its left end, in its middle and at its right end: digits, '.', '-', '+' and 'e'.
struct FalseColorScale {
    std::string low, middle, high;
};

// values: row by row, from 0 (dark) to 1 (light); not a number is green. Linear colours, to be written as .png.
Image false_color_image(std::span<const float> values, int width, int height, const FalseColorScale& scale);

} // namespace plumb
