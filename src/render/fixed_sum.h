// SPDX-License-Identifier: MIT
#pragma once

// Sums of a film: 128-bit integers in units of 2^-64 (film.h).

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace plumb {

__extension__ typedef __int128 FixedSum;

inline constexpr double fixed_unit = 0x1p-64; // what the last bit is worth
inline constexpr double fixed_units_per_one = 0x1p64;

// To the nearest unit. Numbers of 2^62 units and more are whole numbers of units: floats have 24 bits, their squares 48.
inline FixedSum to_fixed(double units)
{
    if (std::abs(units) < 0x1p62) return std::llrint(units);
    return static_cast<FixedSum>(units);
}

// Squares of values from here on are summed aside, in units of 2^-20: below, 2^26 squares add up to less than 2^62.
inline constexpr float fixed_large_value = 0x1p18f;
inline constexpr double fixed_large_unit = 0x1p-20;

// The estimated variance of the mean of n values, n > 1, from their sum, the sum of the squares of those below
// fixed_large_value, and that of the others.
inline double variance_of_mean(FixedSum sum, FixedSum squares, FixedSum large_squares, double n)
{
    const double mean = static_cast<double>(sum) * fixed_unit / n;
    const double mean_square =
        (static_cast<double>(squares) * fixed_unit + static_cast<double>(large_squares) * fixed_large_unit) /
        n;
    return std::max(mean_square - mean * mean, 0.0) / (n - 1.0);
}

// As four words, the lowest first.
inline void put_sum(std::uint32_t* words, FixedSum number)
{
    for (int i = 0; i < 4; ++i) words[i] = static_cast<std::uint32_t>(number >> (32 * i));
}

inline FixedSum get_sum(const std::uint32_t* words)
{
    __extension__ typedef unsigned __int128 Unsigned;
    Unsigned number = 0;
    for (int i = 0; i < 4; ++i) number |= Unsigned{words[i]} << (32 * i);
    return static_cast<FixedSum>(number);
}

} // namespace plumb
