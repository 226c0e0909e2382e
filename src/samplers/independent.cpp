// SPDX-License-Identifier: MIT

// [1] Salmon, Moraes, Dror and Shaw 2011, "Parallel Random Numbers: As Easy as 1, 2, 3", SC'11.

#include "model/plugin.h"
#include "samplers/hashed.h"

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace plumb {
namespace {

// Four words of 32 bits, each in the low half of a lane; what the high halves hold does not matter.
using Lanes [[gnu::vector_size(32)]] = std::uint64_t;

inline Lanes times(Lanes words, std::uint32_t factor)
{
#ifdef __AVX2__
    return reinterpret_cast<Lanes>(
        _mm256_mul_epu32(reinterpret_cast<__m256i>(words), _mm256_set1_epi64x(factor)));
#else
    return (words & 0xFFFFFFFFu) * factor;
#endif
}

// Four counters of 128 bits.
struct Counters {
    Lanes word[4];
};

// Philox4x32 with 10 rounds, [1], section 3.3: a keyed bijection of 128-bit counters whose outputs pass BigCrush. Of
// eight counters at once: a round waits for its multiplications, and they can wait together. The key advances by Weyl
// sequences of the golden ratio and of sqrt(3) - 1.
inline Counters philox_round(const Counters& c, std::uint32_t key_low, std::uint32_t key_high)
{
    const Lanes a = times(c.word[0], 0xD2511F53u);
    const Lanes b = times(c.word[2], 0xCD9E8D57u);
    return {{(b >> 32) ^ (c.word[1] ^ key_low), b, (a >> 32) ^ (c.word[3] ^ key_high), a}};
}

} // namespace

/// Independent uniform random numbers from a counter-based generator (Philox4x32-10): number d of sample i of a
/// pixel is a function of seed, pixel, i and d alone.
///
///     sampleCount   integer   samples per pixel, from 1 to 2^26   (default 1)
///
///         <sampler type="independent">
///             <integer name="sampleCount" value="64"/>
///         </sampler>
class IndependentSampler final : public Sampler {
public:
    explicit IndependentSampler(const Params& params)
        : Sampler(Order::as_drawn), samples_per_pixel_(sample_count(params))
    {}

    std::unique_ptr<Sampler> clone(std::uint64_t) const override
    {
        return std::make_unique<IndependentSampler>(*this);
    }
    std::uint64_t samples_per_pixel() const override { return samples_per_pixel_; }

    void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) override
    {
        seed_ = seed;
        pixel_ = static_cast<std::uint64_t>(pixel.x) | static_cast<std::uint64_t>(pixel.y) << 16;
        sample_index_ = sample_index;
        begin_sample();
    }

private:
    // The first words of eight counters, then their second words, ...
    void fill_block() override
    {
        const auto all = [](std::uint64_t x) { return Lanes{x, x, x, x}; };
        const Lanes index = Lanes{0, 1, 2, 3} + 8 * std::uint64_t{block_number()};
        Counters first{{index, all(pixel_), all(sample_index_), all(sample_index_ >> 32)}};
        Counters second{{index + 4, all(pixel_), all(sample_index_), all(sample_index_ >> 32)}};
        auto key_low = static_cast<std::uint32_t>(seed_);
        auto key_high = static_cast<std::uint32_t>(seed_ >> 32);
        for (int round = 0; round < 10; ++round) {
            first = philox_round(first, key_low, key_high);
            second = philox_round(second, key_low, key_high);
            key_low += 0x9E3779B9u;
            key_high += 0xBB67AE85u;
        }
        for (std::size_t word = 0; word < 4; ++word) {
            for (std::size_t i = 0; i < 4; ++i) {
                block_[8 * word + i] = static_cast<std::uint32_t>(first.word[word][i]);
                block_[8 * word + 4 + i] = static_cast<std::uint32_t>(second.word[word][i]);
            }
        }
    }

    std::uint64_t samples_per_pixel_;
    std::uint64_t seed_ = 0;
    std::uint64_t pixel_ = 0;
    std::uint64_t sample_index_ = 0;
};

template std::unique_ptr<Sampler> build<IndependentSampler>(const Params&);

} // namespace plumb
