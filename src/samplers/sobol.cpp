// SPDX-License-Identifier: MIT

// [1] Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)

#include "model/plugin.h"
#include "samplers/hashed.h"
#include "samplers/sobol_maps.h"

namespace plumb {

/// Owen-scrambled Sobol points (Burley 2020): spreads the samples of a pixel evenly, for less noise.
///
/// Each vertex of a path has two four-dimensional sets of its own, scrambled by hashes of seed, pixel and vertex: one for
/// the next direction, one for the light. The sets of the camera (film and lens) and of the first two vertices are spread
/// evenly together; those of later vertices are shuffled, and have nothing to do with each other. Any 2^k samples from a
/// multiple of 2^k on fill the cells of all grids of 2^k cells in a set's first two dimensions with one each: powers of
/// two are the best numbers of samples, though any will do. Renderings resume and merge as with `independent`. The samples
/// of a pixel are not independent, so their variance overestimates the error: error bars are upper bounds, and what stops
/// by them or compares with them is conservative.
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
    static std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
    static std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

    // The indices of the points of set A and set B, from the end, in the low and the high half.
    std::uint64_t indices_of_sets(std::uint64_t first, std::uint64_t second) const
    {
        if (vertex() < mapped_vertices && block_number() == 0)
            return mapped_indices(vertex(), index_from_end_);
        // [1], listing 3: shuffled.
        return scramble(index_from_end_, low(first), high(first)) |
               std::uint64_t{scramble(index_from_end_, low(second), high(second))} << 32;
    }

    // Set A in the dimensions 0 and 1, set B in these; then the dimension 2 of both, then the dimension 3.
    void fill_block() override
    {
        const std::uint64_t place = std::uint64_t{vertex()} << 32 | block_number();
        const std::uint64_t first = random_word(key_, place);
        const std::uint64_t second = (first ^ first >> 32) * 0xD6E8FEB86659FD93u;
        const std::uint64_t indices = indices_of_sets(first, second);
        const Lanes4 a = sobol_point(low(indices));
        const Lanes4 b = sobol_point(high(indices));
        // [1], listing 3: each dimension scrambled.
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
