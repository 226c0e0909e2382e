// SPDX-License-Identifier: MIT

// [1] Luby and Rackoff 1988, "How to Construct Pseudorandom Permutations from Pseudorandom Functions", SIAM J. Comput. 17(2)
// [2] Black and Rogaway 2002, "Ciphers with Arbitrary Finite Domains", CT-RSA, section 3

#include "interfaces/plugin.h"
#include "samplers/hashed.h"

#include <bit>
#include <cmath>
#include <utility>

namespace plumb {
namespace {

// Where a number goes in a random order of the numbers below `count`: a bijection for each key. Four Feistel rounds [1]
// permute the numbers below the next power of four; what lands beyond `count` is sent on until it does not [2].
std::uint32_t permute(std::uint32_t number, std::uint32_t count, std::uint64_t key)
{
    const int half = (std::bit_width(count - 1) + 1) / 2;
    const std::uint32_t mask = (std::uint32_t{1} << half) - 1;
    do {
        std::uint32_t left = number >> half;
        std::uint32_t right = number & mask;
        for (std::uint64_t round = 0; round < 4; ++round)
            left = std::exchange(right,
                                 left ^ (static_cast<std::uint32_t>(random_word(key + right, round)) & mask));
        number = left << half | right;
    } while (number >= count);
    return number;
}

} // namespace

/// Jittered strata: each pair of numbers that a path draws has a grid of as many cells as there are samples, and each
/// single number as many intervals; each sample of the pixel is in another cell, in random orders of their own.
///
/// The grid is nearly square; if their number has no such factors, a few cells stay empty. The points depend on the total
/// number of samples: a rendering cannot be resumed to more samples, parts with different numbers cannot be merged, and
/// --time and --target-error need --spp as well (`sobol` has no such limits, and less noise). The samples of a pixel are
/// not independent, so their variance overestimates the error: error bars are upper bounds.
///
///     sampleCount   integer   samples per pixel, from 1 to 2^26   (default 1)
///
///         <sampler type="stratified">
///             <integer name="sampleCount" value="64"/>
///         </sampler>
class StratifiedSampler final : public Sampler {
public:
    explicit StratifiedSampler(const Params& params)
        : Sampler(Order::by_vertex), samples_per_pixel_(sample_count(params))
    {
        spread(samples_per_pixel_);
    }

    std::unique_ptr<Sampler> clone(std::uint64_t total) const override
    {
        auto copy = std::make_unique<StratifiedSampler>(*this);
        copy->spread(total);
        return copy;
    }
    std::uint64_t samples_per_pixel() const override { return samples_per_pixel_; }
    bool depends_on_total() const override { return true; }
    bool is_independent() const override { return false; }

    void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) override
    {
        index_ = static_cast<std::uint32_t>(sample_index);
        strata_key_ = pixel_key(seed, pixel);
        jitter_key_ = random_word(strata_key_ ^ 1, sample_index);
        begin_sample();
    }

private:
    void spread(std::uint64_t total)
    {
        total_ = static_cast<std::uint32_t>(total);
        columns_ = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(total)));
        rows_ = (total_ + columns_ - 1) / columns_;
    }

    void fill_block() override
    {
        constexpr std::uint32_t kinds = 6; // two pairs, then four single numbers
        const std::uint64_t place = std::uint64_t{vertex()} << 32 | block_number();
        std::size_t word = 0;
        for (std::uint32_t kind = 0; kind < kinds; ++kind) {
            const std::uint64_t order = random_word(strata_key_, place * kinds + kind);
            const std::uint64_t jitter = random_word(jitter_key_, place * kinds + kind);
            if (kind < 2) {
                const std::uint32_t cell = stratum(columns_ * rows_, order);
                block_[word++] = within(cell % columns_, columns_, static_cast<std::uint32_t>(jitter >> 32));
                block_[word++] = within(cell / columns_, rows_, static_cast<std::uint32_t>(jitter));
            } else {
                block_[word++] =
                    within(stratum(total_, order), total_, static_cast<std::uint32_t>(jitter >> 32));
            }
        }
    }

    // The sample's, of so many; over all keys, each has the same chance.
    std::uint32_t stratum(std::uint32_t count, std::uint64_t key) const
    {
        const std::uint32_t turn = static_cast<std::uint32_t>(key >> 32) % count;
        return (permute(index_, count, key) + turn) % count;
    }

    // A place in one of `count` equal intervals, times 2^32.
    static std::uint32_t within(std::uint32_t interval, std::uint32_t count, std::uint32_t jitter)
    {
        return static_cast<std::uint32_t>((std::uint64_t{interval} << 32 | jitter) / count);
    }

    std::uint64_t samples_per_pixel_;
    std::uint32_t total_ = 1;
    std::uint32_t columns_ = 1;
    std::uint32_t rows_ = 1;
    std::uint32_t index_ = 0;
    std::uint64_t strata_key_ = 0;
    std::uint64_t jitter_key_ = 0;
};

template std::unique_ptr<Sampler> build<StratifiedSampler>(const Params&);

} // namespace plumb
