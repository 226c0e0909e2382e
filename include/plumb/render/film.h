// SPDX-License-Identifier: MIT
#pragma once

// Where samples add up, exactly.
//
// A pixel's sum is a 128-bit integer a channel, in units of 2^-64: integer addition is associative, so the sum has
// the same bits whatever the order, the threads and the passes. A sample is rounded once, to the nearest unit
// (5.4e-20). Range: |sample| < 2^37 (1.4e11) and at most 2^26 samples a pixel, whose sum is below 2^127 units.
// A sample outside that range, not finite, or negative before the filter's weight is left out and counted: never
// wrapped, clamped or repaired.
//
// For the error bars there is also the sum of the samples' squares, in the same units and as exact; the squares of samples
// of 2^18 and more, which few images have, are kept in a table aside, in units of 2^-20. 112 bytes a pixel.
//
// A film may have more channels than beauty: its layers (channel_set.h), which are part of what it is. They cost memory and
// time only where there are some. So do plans, how many samples each pixel gets where pixels decide that (adaptive.h).

#include "plumb/image/image.h"
#include "plumb/math/color.h"
#include "plumb/model/sampler.h"
#include "plumb/render/channel_set.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace plumb {

// Why a sample was left out.
enum class SampleStatus { accepted, not_finite, negative, out_of_range };

inline constexpr float film_max_value = 0x1p37f;
inline constexpr std::uint64_t film_max_samples = max_samples_per_pixel;

// What an image holds: R, G and B, or also variance.R, variance.G and variance.B (Film::variance_of_mean) and
// contributing (Film::contributing_count); of a film with plans also samples (Film::sample_count). After them come the
// film's layers.
enum class Channels { color, color_and_evidence };

class LayerSums;

// Whether a film keeps a plan for each pixel.
enum class Plans { none, kept };

class Film {
public:
    // window: the pixels kept, of an image of full_width x full_height. Throws Error if memory is short or if there are more
    // than max_layers.
    Film(PixelRect window, int full_width, int full_height, ChannelSet layers = {},
         Plans plans = Plans::none);
    Film(Film&&) noexcept;
    Film& operator=(Film&&) noexcept;
    ~Film();

    // What a film with these layers takes in memory.
    static std::size_t bytes_per_pixel(const ChannelSet& layers = {}, Plans plans = Plans::none);

    const PixelRect& window() const { return window_; }
    const ChannelSet& layers() const;
    Plans plans() const { return plans_.empty() ? Plans::none : Plans::kept; }

    // pixel: in coordinates of the full image. weight: the filter's. Different pixels from different threads; one
    // pixel from one thread at a time.
    SampleStatus add(Vec2i pixel, const Color& radiance, float weight);
    // The same, and what the layers have of the sample if it is accepted. number: the sample's index.
    SampleStatus add(Vec2i pixel, const Color& radiance, float weight, const LayerSample& layers,
                     std::uint64_t number);

    std::uint64_t sample_count(Vec2i pixel) const;       // accepted ones
    std::uint64_t contributing_count(Vec2i pixel) const; // those of them that were not black
    // The estimated variance of the pixel's value, channel by channel: the sample variance, s^2 = sum (x - mean)^2 / (n - 1),
    // over n. Unbiased where samples are independent. Not a number, for unknown, below two samples.
    Color variance_of_mean(Vec2i pixel) const;

    // A pixel's plan: how many samples it is to get (adaptive.h), 0 if that is not known yet. Only of a film that keeps them.
    // As for add(): one pixel from one thread at a time.
    std::uint32_t plan(Vec2i pixel) const { return plans_[index(pixel)]; }
    void set_plan(Vec2i pixel, std::uint32_t plan) { plans_[index(pixel)] = plan; }

    // Mean of the accepted samples; black where there is none. The shares of a family, added up in double precision in any
    // order and rounded to float, are R, G and B: for this, one or two of them differ from the nearest float. Shares that
    // cancel do so only as far as their last bits allow.
    Image develop(Channels channels = Channels::color) const;

    // The same of the pixels of a part of the window, by rows: R, G, B and the layers of each. No other thread may add to these
    // pixels meanwhile; to others it may.
    std::vector<float> develop(const PixelRect& part) const;
    std::vector<std::string> channel_names() const; // of both: "R", "G", "B", "normal.X" and so on

    // Adds what another film of the same window has: the film of all the samples of both, bit for bit. Throws Error, and adds
    // nothing, if their layers differ or only one of them keeps plans.
    Film& operator+=(const Film& other);

    // All that is known of a pixel, as 32-bit words, for files: sums and sums of squares of red, green and blue in units of
    // 2^-64, the lowest word first, then sample_count and contributing_count. And the sums of the large squares of red,
    // green and blue in units of 2^-20, which are 0 for most pixels of most films.
    using Words = std::array<std::uint32_t, 26>;
    using LargeWords = std::array<std::uint32_t, 12>;
    Words words(Vec2i pixel) const;
    void set_words(Vec2i pixel, const Words& words);
    bool has_large_squares() const;
    LargeWords large_words(Vec2i pixel) const;
    void set_large_words(Vec2i pixel, const LargeWords& words);
    // The same for the layers: as many as there are names, which tell what they are.
    std::vector<std::string> layer_word_names() const;
    void layer_words(Vec2i pixel, std::span<std::uint32_t> words) const;
    void set_layer_words(Vec2i pixel, std::span<const std::uint32_t> words);
    // Whether so many accepted samples can have these words.
    bool can_have_layer_words(std::span<const std::uint32_t> words, std::uint64_t samples) const;

private:
    __extension__ typedef __int128 Sum;
    struct Pixel {
        Sum sum[3] = {0, 0, 0};
        Sum squares[3] = {0, 0, 0};
        std::uint32_t count = 0; // at most 2^26
        std::uint32_t contributing = 0;
    };
    struct LargeSquares;
    std::size_t index(Vec2i pixel) const;
    void add_channel(std::size_t pixel, int channel, float value);
    double mean(std::size_t pixel, int channel) const;
    double variance_of_mean(std::size_t pixel, int channel) const;

    PixelRect window_;
    int full_width_;
    int full_height_;
    std::vector<Pixel> pixels_;
    std::unique_ptr<LargeSquares> large_squares_;
    std::unique_ptr<LayerSums> layers_; // null if there are none
    std::vector<std::uint32_t> plans_;  // empty if it keeps none
};

} // namespace plumb
