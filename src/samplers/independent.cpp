// SPDX-License-Identifier: MIT

// [1] Salmon, Moraes, Dror and Shaw 2011, "Parallel Random Numbers: As Easy as 1, 2, 3", SC'11.

#include "interfaces/plugin.h"

#include "plumb/sampler.h"

#include <array>

namespace plumb {
namespace {

using Words = std::array<std::uint32_t, 4>;

// The key of one round, [1], section 3.3: Weyl sequences of the golden ratio and of sqrt(3) - 1.
struct Key {
    std::uint32_t low;
    std::uint32_t high;
    void advance()
    {
        low += 0x9E3779B9u;
        high += 0xBB67AE85u;
    }
};

inline Words philox_round(const Words& counter, const Key& key)
{
    const std::uint64_t a = std::uint64_t{0xD2511F53u} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57u} * counter[2];
    return {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key.low, static_cast<std::uint32_t>(b),
            static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key.high, static_cast<std::uint32_t>(a)};
}

// Philox4x32 with 10 rounds, [1], section 3.3: a keyed bijection of 128-bit counters whose outputs pass BigCrush. Of
// this counter and of the next at once: a round waits for its multiplications, and two can wait together.
std::array<std::uint32_t, 8> philox_pair(const Words& counter, std::uint64_t seed)
{
    Key key{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
    Words first = counter;
    Words second{counter[0] + 1, counter[1], counter[2], counter[3]};
    for (int round = 0; round < 10; ++round, key.advance()) {
        first = philox_round(first, key);
        second = philox_round(second, key);
    }
    return {first[0], first[1], first[2], first[3], second[0], second[1], second[2], second[3]};
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
        : samples_per_pixel_(static_cast<std::uint64_t>(params.integer(
              "sampleCount", 1, Range::closed(1.0, static_cast<double>(max_samples_per_pixel)))))
    {}

    std::unique_ptr<Sampler> clone() const override { return std::make_unique<IndependentSampler>(*this); }
    std::uint64_t samples_per_pixel() const override { return samples_per_pixel_; }

    void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) override
    {
        seed_ = seed;
        counter_ = {0, static_cast<std::uint32_t>(pixel.x) | static_cast<std::uint32_t>(pixel.y) << 16,
                    static_cast<std::uint32_t>(sample_index), static_cast<std::uint32_t>(sample_index >> 32)};
        used_ = words_.size();
    }

    float next_1d() override { return to_unit(next_word()); }

    Vec2f next_2d() override
    {
        const float x = to_unit(next_word());
        const float y = to_unit(next_word());
        return {x, y};
    }

    double next_choice() override
    {
        const std::uint64_t high = next_word();
        const std::uint64_t low = next_word();
        return static_cast<double>((high << 32 | low) >> 11) * 0x1p-53;
    }

private:
    static float to_unit(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24f; }

    std::uint32_t next_word()
    {
        if (used_ == words_.size()) {
            words_ = philox_pair(counter_, seed_);
            counter_[0] += 2;
            used_ = 0;
        }
        return words_[used_++];
    }

    std::uint64_t samples_per_pixel_;
    std::uint64_t seed_ = 0;
    Words counter_{}; // block within the sample, pixel, sample index (low and high word)
    std::array<std::uint32_t, 8> words_{};
    std::size_t used_ = words_.size();
};

template std::unique_ptr<Sampler> build<IndependentSampler>(const Params&);

} // namespace plumb
