// SPDX-License-Identifier: MIT
#pragma once

// The interface of samplers: the random numbers of one sample.

#include "plumb/math.h"

#include <array>
#include <memory>

namespace plumb {

// More than anybody asked for; what the film can add up without wrapping (film.h).
inline constexpr std::uint64_t max_samples_per_pixel = std::uint64_t{1} << 26;

// A sample is a point in a space of as many dimensions as a path asks for. Its coordinates are a pure function of
// (seed, pixel, sample index, dimension): whatever was drawn before start() has no influence. Numbers lie in [0, 1).
//
// A sampler makes its coordinates as 32-bit fractions, a block of dimensions at a time, so that drawing one costs no
// call: to be written are fill_block(), which sets all of block_, and start(), which ends in discard_block().
class Sampler {
public:
    virtual ~Sampler() = default;
    virtual std::unique_ptr<Sampler> clone() const = 0; // one a thread
    virtual std::uint64_t samples_per_pixel() const = 0;

    // pixel: in coordinates of the full picture, 0 <= x, y < 65536, so that a crop draws the numbers of the whole.
    virtual void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) = 0;

    float next_1d() { return to_unit(next_words<1>()[0]); }
    Vec2f next_2d()
    {
        const auto [x, y] = next_words<2>();
        return {to_unit(x), to_unit(y)};
    }
    // One dimension with 53 bits, for choosing among many (emitters, triangles, texels): takes the place of two.
    double next_choice()
    {
        const auto [high, low] = next_words<2>();
        return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1p-53;
    }

protected:
    virtual void fill_block() = 0;
    void discard_block() { used_ = block_.size(); }

    std::array<std::uint32_t, 32> block_{}; // the coordinates of the next dimensions, times 2^32

private:
    static float to_unit(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24f; }

    template <std::size_t count>
    std::array<std::uint32_t, count> next_words()
    {
        std::array<std::uint32_t, count> words;
        if (used_ + count <= block_.size()) [[likely]] {
            for (std::size_t i = 0; i < count; ++i) words[i] = block_[used_ + i];
            used_ += count;
        } else {
            for (std::uint32_t& word : words) word = next_word_across_blocks();
        }
        return words;
    }

    std::uint32_t next_word_across_blocks();

    std::size_t used_ = block_.size();
};

} // namespace plumb
