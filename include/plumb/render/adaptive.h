// SPDX-License-Identifier: MIT
#pragma once

// How many samples a pixel gets where each pixel decides that by itself (--adaptive).
//
// A pilot decides: samples of the pixel that are not in the image. So the number of samples is independent of the
// samples that the image has, and their mean and its error bars are as unbiased as those of a fixed number. It is a
// function of the pixel's own pilot and of the target, and of nothing else.

#include <cstdint>
#include <span>

namespace plumb {

// Pilot sample i has this index plus i. No image has so many samples (film.h), and the numbers of all samplers are
// independent of those before 2^30.
inline constexpr std::uint64_t first_pilot_sample = std::uint64_t{1} << 30;

// A pixel's deviation is the mean distance of its samples' luminances from their mean, divided by that mean, or by
// adaptive_floor where it is darker. A pixel whose deviation is 1 gets `usual` samples, 1 / target^2: its relative error
// is then about the target. The number grows with the power 2/3 of the deviation.
//
// Why not with its square, which would give all pixels the same error: the RMSE of an image of given cost is least
// where numbers grow with the standard deviation (Neyman 1934). A pilot knows that only roughly, and least where rare
// bright samples make it. The distance instead of its square, the smaller power, and a least number for all pixels make
// little of rare samples that a pilot has found and others have missed (docs/performance.md has what that brings).
class AdaptiveRule {
public:
    // target: above 0.
    explicit AdaptiveRule(double target);

    std::uint64_t usual() const { return usual_; } // a power of two, as all these numbers
    std::uint64_t least() const;                   // that a pixel gets: half of it, 16 at least
    std::uint64_t pilot_size() const;              // a 32nd of it, 16 at least
    // How many samples the pixel gets, from the luminances of its pilot: from least() to 2^26.
    std::uint64_t samples(std::span<const double> pilot) const;

private:
    std::uint64_t usual_;
};

inline constexpr double adaptive_floor = 0.1;
inline constexpr std::uint64_t least_adaptive_samples = 16;

} // namespace plumb
