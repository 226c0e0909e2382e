// SPDX-License-Identifier: MIT
#pragma once

// How many samples a pixel gets where each pixel decides that by itself (--adaptive).
//
// A pilot decides: samples of the pixel that are not in the image. So the number of samples is independent of the
// samples that the image has, and their mean and its error bars are as unbiased as those of a fixed number. It is a
// function of the pixel's own pilot, the target and the maximum, and of nothing else.

#include <cstdint>
#include <functional>

namespace plumb {

// Pilot sample i has this index plus i. No image has so many samples (film.h), and the numbers of all samplers are
// independent of those before 2^30.
inline constexpr std::uint64_t first_pilot_sample = std::uint64_t{1} << 30;

inline constexpr std::uint64_t least_adaptive_samples = 16;
// Of the smallest pilot; larger ones double it.
inline constexpr std::uint64_t first_pilot = 32;
// A pilot decides on up to so many times as many samples as it has itself.
inline constexpr std::uint64_t samples_per_pilot_sample = 8;
// Luminance below which a pixel's error is not relative to its own mean but to this.
inline constexpr double adaptive_floor = 0.1;

// What is known of a pixel's number of samples: it does not depend on the maximum for which it was looked at.
struct PixelPlan {
    std::uint64_t samples = 0; // a power of two; 0: nothing is known yet
    bool is_final = false;     // else it will be that at least

    // Whether it says all that an image with this maximum needs.
    bool reaches(std::uint64_t maximum) const { return samples > 0 && (is_final || samples >= maximum); }

    // For the film; plans that know more of the same pixel are larger words.
    std::uint32_t word() const { return static_cast<std::uint32_t>(2 * samples + (is_final ? 1 : 0)); }
    static PixelPlan from_word(std::uint32_t word) { return {word / 2, word % 2 != 0}; }
    friend bool operator==(const PixelPlan&, const PixelPlan&) = default;
};

// The statistics of a pilot, whose samples come in the order of their numbers. value: luminance, at least 0.
class Pilot {
public:
    void add(double value);
    std::uint64_t size() const { return size_; }
    // The number of samples, a power of two, that meets the target if the statistics are right.
    std::uint64_t wanted(double target) const;

private:
    static constexpr std::uint64_t block = 16; // samples: aligned, so of a Sobol sequence each is evenly spread

    std::uint64_t size_ = 0;
    double block_sum_ = 0.0;
    // Welford's, of the means of whole blocks.
    double blocks_ = 0.0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

// take(i): the luminance of pilot sample i; asked for each once, from 0 on.
PixelPlan plan_pixel(double target, std::uint64_t maximum,
                     const std::function<double(std::uint64_t)>& take);

} // namespace plumb
