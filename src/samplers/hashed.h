// SPDX-License-Identifier: MIT
#pragma once

// What samplers have in common: the parameter, and random words for whole pixels.

#include "plumb/model/params.h"
#include "plumb/model/sampler.h"

namespace plumb {

inline std::uint64_t sample_count(const Params& params)
{
    return static_cast<std::uint64_t>(
        params.integer("sampleCount", 1, Range::closed(1.0, static_cast<double>(max_samples_per_pixel))));
}

// Word `number` of the stream that a key begins: SplitMix64 (Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom
// Number Generators", OOPSLA'14, figure 17). Its numbers go to any place of the stream at once.
inline std::uint64_t random_word(std::uint64_t key, std::uint64_t number)
{
    std::uint64_t x = key + (number + 1) * 0x9E3779B97F4A7C15u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

// The uniform numbers of such a stream, one after the other, in [0, 1): as a Sampler draws them.
class RandomStream {
public:
    explicit RandomStream(std::uint64_t key) : key_(key) {}

    double next_choice() { return static_cast<double>(random_word(key_, next_++) >> 11) * 0x1p-53; }
    float next_1d() { return static_cast<float>(random_word(key_, next_++) >> 40) * 0x1p-24f; }
    Vec2f next_2d()
    {
        const float x = next_1d();
        const float y = next_1d();
        return {x, y};
    }

private:
    std::uint64_t key_;
    std::uint64_t next_ = 0;
};

// A key for a pixel; rest: whatever else is to have numbers of its own, below 2^32. Keys of one seed differ.
inline std::uint64_t pixel_key(std::uint64_t seed, Vec2i pixel, std::uint64_t rest = 0)
{
    const std::uint64_t place =
        static_cast<std::uint64_t>(pixel.x) | static_cast<std::uint64_t>(pixel.y) << 16 | rest << 32;
    return random_word(random_word(seed, 0) ^ place, 0);
}

} // namespace plumb
