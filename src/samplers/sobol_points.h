// SPDX-License-Identifier: MIT
#pragma once

// Points of Sobol's sequence and Owen's scrambling, on words.
//
// [1] Joe and Kuo 2008, "Constructing Sobol Sequences with Better Two-dimensional Projections", SIAM J. Sci. Comput. 30
// [2] Vegdahl 2021, "Building a Better LK Hash", https://psychopath.io/post/2021_01_30_building_a_better_lk_hash
//
// Words "from the end" have their bits in reverse order: bit 0 is the half, bit 1 the quarter, and so on. There Owen's
// scrambling flips each bit by a function of those below it, and this is what sums and products of words do.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace plumb {

using Lanes4 [[gnu::vector_size(16)]] = std::uint32_t;
using Lanes8 [[gnu::vector_size(32)]] = std::uint32_t;

inline constexpr std::size_t index_bits = 30;
inline constexpr std::size_t digit_bits = 6; // as many of them are looked up at once
inline constexpr std::size_t digits = index_bits / digit_bits;
inline constexpr std::size_t digit_values = std::size_t{1} << digit_bits;

// The first four dimensions of Sobol's sequence with the direction numbers of [1], from the end.
constexpr std::array<std::array<std::uint32_t, index_bits>, 4> direction_numbers()
{
    struct Polynomial {
        std::size_t degree;
        std::uint32_t coefficients; // a_1 is the highest bit
        std::uint32_t m[3];
    };
    constexpr Polynomial polynomials[3] = {{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}};
    std::array<std::array<std::uint32_t, index_bits>, 4> columns{};
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
        std::uint32_t m[index_bits]{};
        for (std::size_t k = 0; k < index_bits; ++k) {
            if (dimension == 0) {
                m[k] = 1;
                continue;
            }
            const Polynomial& p = polynomials[dimension - 1];
            if (k < p.degree) {
                m[k] = p.m[k];
                continue;
            }
            m[k] = m[k - p.degree] ^ (m[k - p.degree] << p.degree); // [1], equation 2
            for (std::size_t i = 1; i < p.degree; ++i)
                if ((p.coefficients >> (p.degree - 1 - i) & 1) != 0) m[k] ^= m[k - i] << i;
        }
        // Direction number k is m_k / 2^(k + 1): its bit i from the end is bit k - i of m_k.
        for (std::size_t k = 0; k < index_bits; ++k)
            for (std::size_t i = 0; i <= k; ++i) columns[dimension][k] |= (m[k] >> (k - i) & 1) << i;
    }
    return columns;
}

// What each value of a digit of an index from the end adds to the four dimensions.
struct DigitTable {
    alignas(16) std::uint32_t words[digits][digit_values][4];
};

constexpr DigitTable digit_table()
{
    constexpr auto columns = direction_numbers();
    DigitTable table{};
    for (std::size_t digit = 0; digit < digits; ++digit)
        for (std::size_t value = 0; value < digit_values; ++value)
            for (std::size_t bit = 0; bit < digit_bits; ++bit)
                for (std::size_t dimension = 0; dimension < 4; ++dimension)
                    if ((value >> bit & 1) != 0)
                        table.words[digit][value][dimension] ^=
                            columns[dimension][index_bits - 1 - (digit_bits * digit + bit)];
    return table;
}

inline constexpr DigitTable sobol_table = digit_table();

// The four dimensions of a point, from the end.
inline Lanes4 sobol_point(std::uint32_t index_from_end)
{
    Lanes4 point{};
    for (std::size_t digit = 0; digit < digits; ++digit) {
        Lanes4 part;
        const std::size_t value = index_from_end >> (digit_bits * digit) & (digit_values - 1);
        std::memcpy(&part, sobol_table.words[digit][value], sizeof part);
        point ^= part;
    }
    return point;
}

// Owen's scrambling of words from the end: the hash of Laine and Karras as [2] corrected it. Two random words make the
// scrambling: of an uniform shift the result is uniform, whatever the factor.
template <class Word>
inline Word scramble(Word x, Word shift, Word factor)
{
    x ^= x * 0x3D20ADEAu;
    x += shift;
    x *= factor | 1u;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return x;
}

template <class Word>
inline Word reverse_bits(Word x)
{
    x = (x >> 16) | (x << 16);
    x = ((x >> 8) & 0x00FF00FFu) | ((x & 0x00FF00FFu) << 8);
    x = ((x >> 4) & 0x0F0F0F0Fu) | ((x & 0x0F0F0F0Fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

} // namespace plumb
