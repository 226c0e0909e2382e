// SPDX-License-Identifier: MIT
#pragma once

// Where samples add up, exactly.
//
// A pixel's sum is a 128-bit integer a channel, in units of 2^-64: integer addition is associative, so the sum has
// the same bits whatever the order, the threads and the passes. A sample is rounded once, to the nearest unit
// (5.4e-20). Range: |sample| < 2^37 (1.4e11) and at most 2^26 samples a pixel, whose sum is below 2^127 units.
// A sample outside that range, not finite, or negative before the filter's weight is left out and counted: never
// wrapped, clamped or repaired. 64 bytes a pixel.

#include "plumb/color.h"
#include "plumb/image.h"
#include "plumb/sampler.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace plumb {

// Why a sample was left out.
enum class Verdict { accepted, not_finite, negative, out_of_range };

inline constexpr float film_max_value = 0x1p37f;
inline constexpr std::uint64_t film_max_samples = max_samples_per_pixel;
inline constexpr std::size_t film_bytes_per_pixel = 64;

class Film {
public:
    // window: the pixels kept, of a picture of full_width x full_height. Throws Error if memory is short.
    Film(PixelRect window, int full_width, int full_height);

    const PixelRect& window() const { return window_; }

    // pixel: in coordinates of the full picture. weight: the filter's. Different pixels from different threads; one
    // pixel from one thread at a time.
    Verdict add(Vec2i pixel, const Color& radiance, float weight);

    std::uint64_t sample_count(Vec2i pixel) const; // accepted ones
    Image develop() const;                         // mean of the accepted samples; black where there is none

private:
    __extension__ typedef __int128 Sum;
    struct Pixel {
        Sum sum[3] = {0, 0, 0};
        std::uint64_t count = 0;
    };
    Pixel& at(Vec2i pixel);
    const Pixel& at(Vec2i pixel) const;

    PixelRect window_;
    int full_width_;
    int full_height_;
    std::vector<Pixel> pixels_;
};

} // namespace plumb
