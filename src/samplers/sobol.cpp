// SPDX-License-Identifier: MIT

// [1] Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)
// [2] Joe and Kuo 2008, "Constructing Sobol Sequences with Better Two-dimensional Projections", SIAM J. Sci. Comput. 30
// [3] Vegdahl 2021, "Building a Better LK Hash", https://psychopath.io/post/2021_01_30_building_a_better_lk_hash

#include "interfaces/plugin.h"
#include "samplers/hashed.h"

#include <cstring>

namespace plumb {
namespace {

using Lanes4 [[gnu::vector_size(16)]] = std::uint32_t;
using Lanes8 [[gnu::vector_size(32)]] = std::uint32_t;

// Words "from the end" have their bits in reverse order: bit 0 is the half, bit 1 the quarter, and so on. There Owen's
// scrambling flips each bit by a function of those below it, and this is what sums and products of words do.

constexpr std::size_t index_bits = 30;
constexpr std::size_t digit_bits = 6; // as many of them are looked up at once
constexpr std::size_t digits = index_bits / digit_bits;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;

// The first four dimensions of Sobol's sequence with the direction numbers of [2], from the end.
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
            m[k] = m[k - p.degree] ^ (m[k - p.degree] << p.degree); // [2], equation 2
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

constexpr DigitTable sobol_table = digit_table();

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

// Owen's scrambling of words from the end: the hash of Laine and Karras as [3] corrected it. Two random words make the
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

} // namespace

/// Owen-scrambled Sobol points (Burley 2020): spreads the samples of a pixel evenly, for less noise.
///
/// Each vertex of a path has two four-dimensional sets of its own, shuffled and scrambled by hashes of seed, pixel and
/// vertex: one for the next direction, one for the light. Any 2^k samples from a multiple of 2^k on fill the cells of all
/// grids of 2^k cells in a set's first two dimensions with one each: powers of two are the best numbers of samples,
/// though any will do. Renderings resume and merge as with `independent`. The samples of a pixel are not independent, so
/// their variance overestimates the error: error bars are upper bounds, and what stops by them or compares with them is
/// conservative.
///
///     sampleCount   integer   samples per pixel, from 1 to 2^26   (default 1)
///
///         <sampler type="sobol">
///             <integer name="sampleCount" value="64"/>
///         </sampler>
class SobolSampler final : public Sampler {
public:
    explicit SobolSampler(const Params& params)
        : Sampler(Order::by_vertex), samples_per_pixel_(sample_count(params))
    {}

    std::unique_ptr<Sampler> clone(std::uint64_t) const override
    {
        return std::make_unique<SobolSampler>(*this);
    }
    std::uint64_t samples_per_pixel() const override { return samples_per_pixel_; }
    bool is_independent() const override { return false; }

    void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) override
    {
        index_from_end_ = reverse_bits(static_cast<std::uint32_t>(sample_index)) >> (32 - index_bits);
        key_ = pixel_key(seed, pixel, sample_index >> index_bits);
        begin_sample();
    }

private:
    // Set A in the dimensions 0 and 1, set B in these; then the dimension 2 of both, then the dimension 3.
    void fill_block() override
    {
        const std::uint64_t place = std::uint64_t{vertex()} << 32 | block_number();
        const std::uint64_t first = random_word(key_, place);
        const std::uint64_t second = (first ^ first >> 32) * 0xD6E8FEB86659FD93u;
        const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
        const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };

        // [1], listing 3: the indices shuffled, then each dimension scrambled.
        const Lanes4 a = sobol_point(scramble(index_from_end_, low(first), high(first)));
        const Lanes4 b = sobol_point(scramble(index_from_end_, low(second), high(second)));
        const Lanes8 points = __builtin_shufflevector(a, b, 0, 1, 4, 5, 2, 6, 3, 7);
        const Lanes8 shifts = lane_words(high(first), low(second));
        const Lanes8 factors = __builtin_shufflevector(shifts, shifts, 1, 2, 3, 0, 5, 6, 7, 4);
        const Lanes8 words = reverse_bits(scramble(points, shifts, factors));
        std::memcpy(block_.data(), &words, sizeof words);
    }

    // A random word for each of eight lanes: the finaliser of MurmurHash3 of their numbers, with the two words as its key.
    static Lanes8 lane_words(std::uint32_t first, std::uint32_t second)
    {
        constexpr std::uint32_t step = 0x9E3779B9u;
        Lanes8 x{0, step, 2 * step, 3 * step, 4 * step, 5 * step, 6 * step, 7 * step};
        x += first;
        x = (x ^ (x >> 16)) * 0x85EBCA6Bu;
        x = (x ^ (x >> 13) ^ second) * 0xC2B2AE35u;
        return x ^ (x >> 16);
    }

    std::uint64_t samples_per_pixel_;
    std::uint64_t key_ = 0;
    std::uint32_t index_from_end_ = 0;
};

template std::unique_ptr<Sampler> build<SobolSampler>(const Params&);

} // namespace plumb
