// SPDX-License-Identifier: MIT
#pragma once

// Several points of the unit square from the numbers of one: each is uniform, and together they are spread.
//
// [1] Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"

#include "plumb/sampling/sampling.h"

#include <cmath>

namespace plumb {

inline double wrapped(double x)
{
    return x - std::floor(x);
}

// The i-th, by the shifts of [1]; the first is u.
inline Vec2f shifted(const Vec2f& u, int i)
{
    const auto by = [&](float x, double step) {
        return std::min(static_cast<float>(wrapped(static_cast<double>(x) + step * i)), one_minus_epsilon);
    };
    return {by(u.x, 0.7548776662466927), by(u.y, 0.5698402909980532)};
}

} // namespace plumb
