// SPDX-License-Identifier: MIT
#pragma once

// How the four-dimensional sets of a path's first vertices are made one set of more dimensions: each takes Sobol's points
// in an order of its own, which is a linear map of the sample's index. The maps are upper triangular (a bit of the result
// depends on that bit of the index and on higher ones): they reorder the points within each aligned block of 2^k, so
// that a set alone remains what it was.
//
// The maps are chosen by tools/sobol_maps.cpp, which says what is well spread together.

#include "samplers/sobol_points.h"

namespace plumb {

// The camera's vertex and the first two of the path, with two sets each.
inline constexpr std::size_t mapped_vertices = 3;
inline constexpr std::size_t mapped_sets = 2 * mapped_vertices;

// Of as many bits of the index. Column k of a map is what bit k of the index adds: here the bits 0 to k of the result,
// the highest first, of which the last is 1.
inline constexpr std::size_t chosen_columns = 14;
inline constexpr std::uint32_t chosen[mapped_sets][chosen_columns] = {
    {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1},                       // film
    {1, 1, 7, 3, 27, 49, 33, 229, 231, 571, 1157, 2871, 3833, 2007},  // lens
    {1, 3, 1, 15, 9, 31, 67, 227, 441, 115, 1219, 2261, 7747, 12601}, // direction at the first vertex
    {1, 3, 1, 11, 29, 21, 121, 195, 13, 733, 579, 2559, 5349, 12961}, // light
    {1, 3, 7, 11, 7, 47, 101, 115, 225, 691, 131, 1769, 1699, 7415},  // direction at the second vertex
    {1, 3, 3, 1, 19, 15, 1, 151, 187, 443, 1663, 611, 3349, 12993},   // light
};

// Beyond, where a pixel has more than 2^14 samples, they are random.
constexpr std::uint32_t random_column(std::size_t set, std::size_t k)
{
    std::uint64_t x = (set * index_bits + k + 1) * 0x9E3779B97F4A7C15u; // SplitMix64
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return static_cast<std::uint32_t>(x >> 32) % (std::uint32_t{1} << k) << 1 | 1u;
}

// What each value of a digit of an index from the end adds to both sets of a vertex, from the end: the first in the low
// half.
struct MapTable {
    std::uint64_t words[mapped_vertices][digits][digit_values];
};

constexpr MapTable map_table()
{
    MapTable table{};
    for (std::size_t set = 0; set < mapped_sets; ++set)
        for (std::size_t k = 0; k < index_bits; ++k) {
            const std::uint32_t rows = k < chosen_columns ? chosen[set][k] : random_column(set, k);
            const std::size_t bit = index_bits - 1 - k; // of the index and the result, from the end
            const std::uint64_t column = std::uint64_t{rows} << bit << 32 * (set % 2);
            for (std::size_t value = 0; value < digit_values; ++value)
                if ((value >> bit % digit_bits & 1) != 0)
                    table.words[set / 2][bit / digit_bits][value] ^= column;
        }
    return table;
}

inline constexpr MapTable sobol_map_table = map_table();

// The indices of both sets of a vertex, from the end.
inline std::uint64_t mapped_indices(std::uint32_t vertex, std::uint32_t index_from_end)
{
    std::uint64_t indices = 0;
    for (std::size_t digit = 0; digit < digits; ++digit)
        indices ^=
            sobol_map_table.words[vertex][digit][index_from_end >> (digit_bits * digit) & (digit_values - 1)];
    return indices;
}

} // namespace plumb
