// SPDX-License-Identifier: MIT
#pragma once

// What a comparison reads of an image, by the names of the channels.

#include "plumb/compare/compare.h"

namespace plumb {

struct ComparedImage {
    PixelRect window; // the pixels that exist
    int full_width = 0;
    int full_height = 0;
    std::vector<std::string> channels; // R, G and B, or Y, or those of a layer: at most three
    std::vector<float> values;         // of each pixel, its channels
    std::vector<float> variances;      // likewise; empty: unknown
    std::vector<float> contributing;   // one a pixel; empty: unknown
    std::optional<double> samples_per_pixel;
    // Degrees of freedom of a pixel's variance, where they are not samples_per_pixel - 1.
    std::optional<double> freedom;
    double inflation = 1.0;      // variance of a sum of pixels over the sum of their variances
    std::string noise = "none";  // where the variances come from
    bool is_for_screens = false; // 8-bit integers or the like: rounded, and clipped at 1
    std::string display;       // development.h's display_text: values with different texts are not comparable
    std::string denoised;      // by what; empty: nothing says that it was
    bool is_luminance = false; // of an image that has colours as well
    bool is_half = false;      // 16-bit floats can hold every value
    std::string estimator;     // Estimate's
    std::string seed;          // of its random numbers; empty: unknown

    std::size_t pixels() const { return values.size() / channels.size(); }
    bool is_exact = false; // has no noise, whatever the channels say
    bool knows_noise() const { return is_exact || !variances.empty(); }
    float value(std::size_t pixel, std::size_t channel) const
    {
        return values[pixel * channels.size() + channel];
    }
    double variance(std::size_t pixel, std::size_t channel) const
    {
        return is_exact ? 0.0 : static_cast<double>(variances[pixel * channels.size() + channel]);
    }
    Color color(std::size_t pixel) const; // grey where there is one channel; blue is 0 where there are two
    bool is_finite(std::size_t pixel) const;
    // All channels have a variance that is known: finite and not negative.
    bool variance_is_known(std::size_t pixel) const;
};

// `side` names the image in messages. Channels: channel_names.h; the layer, variance_of and samples of the options
// count. Throws Error if they are not there.
ComparedImage make_compared_image(const Image& image, Side side, const CompareSettings& options);

// Both, of which one may lack a layer of colours, or be in luminance only: then the other is taken likewise.
std::pair<ComparedImage, ComparedImage> make_compared_images(const Image& a, const Image& b,
                                                             const CompareSettings& options);

// The samples of both have one distribution.
bool are_of_one_estimator(const ComparedImage& a, const ComparedImage& b);
// And the same random numbers.
bool share_random_numbers(const ComparedImage& a, const ComparedImage& b);

// Of both images: the same channels, sizes and windows. Throws Error.
void check_comparable(const ComparedImage& a, const ComparedImage& b);

} // namespace plumb
