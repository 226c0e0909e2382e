// SPDX-License-Identifier: MIT
#pragma once

// Which channels of an image file are its colours, and which tell of their noise, by their names.
//
// Colours: R, G and B; r, g and b; Y; or those of the only layer with these names (ViewLayer.Combined.R), or of the
// only one whose name ends in Combined, beauty, rgba or color. Variances:
//
//   variance.R                   of a pixel's mean (Plumb)
//   variance_of_NAME.R           likewise of the layer NAME
//   Variance.R                   of a sample (pbrt-v4's film gbuffer): needs the number of samples per pixel
//   m2_NAME.R beside NAME.R      the mean of the samples' squares (Mitsuba's integrator moment): likewise
//
// The number of samples is the header's plumb:samplesPerPixel or samplesPerPixel.

#include "plumb/image/image.h"
#include "plumb/settings/compare_settings.h"

#include <optional>
#include <string>
#include <vector>

namespace plumb {

enum class VarianceKind { of_mean, of_sample, second_moment };

struct ChosenChannels {
    std::vector<std::string> names;     // R, G, B; Y; or those of a layer, with its name
    std::vector<std::size_t> values;    // their places
    std::vector<std::size_t> variances; // likewise; empty: none
    VarianceKind kind = VarianceKind::of_mean;
    std::string variance_name; // "Variance.*", for messages
    std::optional<std::size_t> contributing;
    bool is_luminance = false; // of an image that has colours as well
};

// layer: empty, or the channels layer.* count instead of the colours. `side` names the image in messages. Mitsuba's
// moments, which are of luminance beside R, G and B, are taken only if the number of samples is known. Throws Error if
// there are no such channels.
ChosenChannels choose_channels(const Image& image, Side side, const std::string& layer,
                               bool samples_are_known);

// The channels that show what the image looks like: R, G and B, Y, or those of its main layer; empty: there are none.
std::vector<std::string> color_channels(const Image& image);
std::vector<std::string> layers_of(const Image& image);
// What stands before the last dot of a channel's name, if there is one, and behind it.
std::string layer_of(const std::string& channel);
std::string part_of(const std::string& channel);

bool has_layer(const Image& image, const std::string& layer);
bool is_layer_of_colors(const Image& image,
                        const std::string& layer); // red, green and blue, with or without alpha
bool has_colors(const Image& image);               // red, green and blue

// What the header says, or else the options.
struct NoiseFacts {
    std::optional<double> samples;
    std::optional<int> replicas; // the image is the mean of so many
    double inflation = 1.0;      // of replicas: of their noise
    bool is_ours = false;        // Plumb's channels mean what their names say
};
NoiseFacts noise_facts(const Image& image, const CompareSettings& options);
VarianceKind variance_kind(const ChosenChannels& chosen, const NoiseFacts& facts,
                           const CompareSettings& options);

// Empty if there is no such entry.
std::string header_text(const Image& image, std::string_view name);

// Entries that Plumb's own functions write for make_image().
inline constexpr const char* replicas_mark = "plumb:replicas";
inline constexpr const char* inflation_mark = "plumb:noiseInflation";
inline constexpr const char* screen_mark = "plumb:forScreens";

} // namespace plumb
