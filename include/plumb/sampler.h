// SPDX-License-Identifier: MIT
#pragma once

// The interface of samplers: the random numbers of one sample.

#include "plumb/math.h"

#include <memory>

namespace plumb {

// More than anybody asked for; what the film can add up without wrapping (film.h).
inline constexpr std::uint64_t max_samples_per_pixel = std::uint64_t{1} << 26;

// A sample is a point in a space of as many dimensions as a path asks for. Its coordinates are a pure function of
// (seed, pixel, sample index, dimension): whatever was drawn before start() has no influence. Numbers lie in [0, 1).
class Sampler {
public:
    virtual ~Sampler() = default;
    virtual std::unique_ptr<Sampler> clone() const = 0; // one a thread
    virtual std::uint64_t samples_per_pixel() const = 0;

    // pixel: in coordinates of the full picture, 0 <= x, y < 65536, so that a crop draws the numbers of the whole.
    virtual void start(std::uint64_t seed, Vec2i pixel, std::uint64_t sample_index) = 0;

    virtual float next_1d() = 0;
    virtual Vec2f next_2d() = 0;
    // One dimension with 53 bits, for choosing among many (emitters, triangles, texels).
    virtual double next_choice() = 0;
};

} // namespace plumb
