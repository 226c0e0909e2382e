// SPDX-License-Identifier: MIT
#pragma once

// A plane of squares in two alternating colours: what both kinds of checkerboard are made of.

#include "plumb/math/color.h"

namespace plumb {

// Cell (i, j) covers i <= x < i + 1 and j <= y < j + 1, also where they are negative; cells with even i + j have the
// first colour.
struct TwoColors {
    Color first;
    Color second;

    Color at(float x, float y) const
    {
        const bool even_x = is_even(std::floor(x));
        const bool even_y = is_even(std::floor(y));
        return even_x == even_y ? first : second;
    }

    // Over the rectangle from (x0, y0) to (x1, y1), x0 < x1 and y0 < y1; but the average of both colours where the
    // rectangle shows only black and the other colour is not.
    Color mean(double x0, double x1, double y0, double y1) const
    {
        const double even_x = (even_length(x1) - even_length(x0)) / (x1 - x0);
        const double even_y = (even_length(y1) - even_length(y0)) / (y1 - y0);
        const auto share = static_cast<float>(even_x * even_y + (1.0 - even_x) * (1.0 - even_y));
        const Color average = first * share + second * (1.f - share);
        return average.is_black() ? (first + second) * 0.5f : average;
    }

    float min_value() const { return std::min(min_component(first), min_component(second)); }
    float max_value() const { return std::max(max_component(first), max_component(second)); }

private:
    static bool is_even(float whole) { return whole == 2.f * std::floor(whole * 0.5f); }

    // The integral from 0 to x of 1 where floor is even, 0 where it is odd.
    static double even_length(double x)
    {
        const double pairs = std::floor(x * 0.5);
        return pairs + std::min(x - 2.0 * pairs, 1.0);
    }
};

} // namespace plumb
