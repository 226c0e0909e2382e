// SPDX-License-Identifier: MIT
#pragma once

// The named channels that a film has besides beauty: layers, each with its components. "albedo" with the components R, G and B
// is in files as albedo.R, albedo.G and albedo.B.

#include "plumb/math/color.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// How the samples of a pixel become its value. All are exact, and independent of the order of the samples.
enum class LayerKind {
    mean, // over all samples, with the filter's weights: what sees nothing counts as 0
    mean_of_hits, // over the samples that have a value, without weights: never outside the range of the values; 0 if none has
    id,       // of the pixel's first sample, by its index: 0 or an index into a table, from 1
    variance, // of what `mean` gives: estimated as Film::variance_of_mean; not a number below two samples
    variance_of_hits, // of what `mean_of_hits` gives; 0 if no sample has a value, not a number if one has
    share, // of beauty: those whose names are the same up to the last dot are a family, and add up to beauty
};

constexpr bool is_of_hits(LayerKind kind)
{
    return kind == LayerKind::mean_of_hits || kind == LayerKind::variance_of_hits;
}

constexpr bool is_variance(LayerKind kind)
{
    return kind == LayerKind::variance || kind == LayerKind::variance_of_hits;
}

struct Layer {
    std::string name;
    std::vector<std::string> components; // one of an id
    LayerKind kind = LayerKind::mean;
    friend bool operator==(const Layer&, const Layer&) = default;

    std::string channel(std::size_t component) const { return name + "." + components[component]; }
};

// Letters, digits, '_', '-' and inner dots; up to 64 of them.
bool is_layer_name(std::string_view text);

inline constexpr std::size_t max_layers = 64;

// Two films with equal ones have the same channels and may be added. Empty: beauty only.
using ChannelSet = std::vector<Layer>;

// "albedo:R,G,B:mean normal:X,Y,Z:hits object:id:id variance_of_uv:U,V:variance_of_hits"; of nothing "none". And back, which throws Error for any other text.
std::string to_text(const ChannelSet& layers);
ChannelSet channel_set_from_text(std::string_view text);

// What the layers of one family of shares have in common: "by_depth" of "by_depth.2".
std::string_view family_of(const Layer& share);

// For people: "albedo, normal"; of nothing "none".
std::string layer_names(const ChannelSet& layers);

// A contribution to a sample, and where it counts.
inline constexpr std::size_t max_families = 3;
struct LightShare {
    Color sum; // of the contributions up to this one; the last one's is the sample's radiance
    std::array<std::uint32_t, max_families> layers; // one of each family of shares, by its index
};

// What one sample has for the layers, in their order: a float for each component of those that are neither ids nor shares, and
// an integer for each id.
struct LayerSample {
    std::span<const float> values;
    std::span<const std::uint32_t> ids;
    std::uint64_t hits = 0; // a bit for each layer, the first is 1: whether it has a value
    std::span<const LightShare> shares = {};
    std::size_t families = 0; // of shares
};

} // namespace plumb
