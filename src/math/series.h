// SPDX-License-Identifier: MIT
#pragma once

// Taylor series, for elementary.cpp and for code that cannot afford a call.
//
// [1] Estrin 1960: a polynomial as a tree, which is faster than Horner's chain.

#include "plumb/math/elementary.h"

#include <array>
#include <cstddef>

namespace plumb {

// c[0] + c[1] x + c[2] x^2 + ..., by [1].
template <std::size_t size>
inline double polynomial(const std::array<double, size>& c, double x)
{
    if constexpr (size == 1) {
        return c[0];
    } else {
        std::array<double, (size + 1) / 2> pairs{};
        for (std::size_t i = 0; i < pairs.size(); ++i)
            pairs[i] = 2 * i + 1 < size ? c[2 * i] + x * c[2 * i + 1] : c[2 * i];
        return polynomial(pairs, x * x);
    }
}

// size terms, beginning with the first: sign^i / (first + step i)!.
template <std::size_t size>
constexpr std::array<double, size> inverse_factorials(int first, int step, double sign)
{
    std::array<double, size> terms{};
    double factorial = 1.0;
    int n = 1;
    for (std::size_t i = 0; i < size; ++i) {
        for (; n <= first + step * static_cast<int>(i); ++n) factorial *= n;
        terms[i] = (i % 2 == 0 ? 1.0 : sign) / factorial;
    }
    return terms;
}

// Sine and cosine of |x| <= pi/4 with relative errors of 1e-11, for results that will be rounded to float.
inline SinCosD sin_cos_near_zero_for_float(double x)
{
    static constexpr auto sin_terms = inverse_factorials<5>(3, 2, -1.0);
    static constexpr auto cos_terms = inverse_factorials<6>(2, 2, -1.0);
    const double x2 = x * x;
    return {x - x * x2 * polynomial(sin_terms, x2), 1.0 - x2 * polynomial(cos_terms, x2)};
}

inline SinCos sin_cos_in_first_octant(float x) // |x| <= pi/4: sin_cos(x) without the reduction
{
    const SinCosD result = sin_cos_near_zero_for_float(static_cast<double>(x));
    return {static_cast<float>(result.sin), static_cast<float>(result.cos)};
}

} // namespace plumb
