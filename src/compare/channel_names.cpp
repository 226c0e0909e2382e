// SPDX-License-Identifier: MIT
#include "compare/channel_names.h"

#include "base/lower_case.h"
#include "plumb/base/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace plumb {

namespace {

using Names = std::vector<std::string>;
using Places = std::vector<std::size_t>;

// The places of all of them, in their order; nothing if one is missing.
std::optional<Places> find_channels(const Image& image, const Names& names)
{
    const Names& all = image.channel_names();
    Places places;
    for (const std::string& name : names) {
        const auto found = std::find(all.begin(), all.end(), name);
        if (found == all.end()) return {};
        places.push_back(static_cast<std::size_t>(found - all.begin()));
    }
    return places;
}

Names prefixed(const std::string& prefix, const Names& names)
{
    Names all;
    for (const std::string& name : names) all.push_back(prefix + name);
    return all;
}

// "R", "G", "B" or "r", "g", "b" behind the prefix.
std::optional<Names> colors_behind(const Image& image, const std::string& prefix)
{
    for (const Names& names : {Names{"R", "G", "B"}, Names{"r", "g", "b"}})
        if (find_channels(image, prefixed(prefix, names))) return prefixed(prefix, names);
    return {};
}

// Tells of noise, not of light.
bool is_of_noise(const std::string& layer)
{
    const std::string lower = lower_case(layer);
    return lower == "variance" || lower == "relativevariance" || layer.starts_with("variance_of_") ||
           layer.starts_with("m2_");
}

// The layer that an image of layers alone shows.
std::string main_layer(const Image& image)
{
    Names layers;
    Names preferred;
    for (const std::string& layer : layers_of(image)) {
        if (is_of_noise(layer) || !colors_behind(image, layer + ".")) continue;
        layers.push_back(layer);
        const std::string last = lower_case(layer.substr(layer.rfind('.') + 1));
        for (const char* name : {"combined", "beauty", "rgba", "color"})
            if (last == name) preferred.push_back(layer);
    }
    if (layers.size() == 1) return layers.front();
    return preferred.size() == 1 ? preferred.front() : "";
}

const char* name_of(Side side)
{
    return side == Side::a ? "A" : "B";
}

// Red, green and blue in this order without alpha, others by their names.
Names channels_of_layer(const Image& image, Side side, const std::string& layer)
{
    Names names;
    for (const std::string& name : image.channel_names())
        if (layer_of(name) == layer) names.push_back(name);
    if (names.empty()) {
        const Names layers = layers_of(image);
        throw Error(fmt::format("{} has no layer '{}'; it has {}", name_of(side), layer,
                                layers.empty() ? "none" : fmt::format("{}", fmt::join(layers, ", "))));
    }
    if (const auto colors = colors_behind(image, layer + "."); colors && names.size() <= 4) {
        const auto is_extra = [&](const std::string& name) {
            return std::find(colors->begin(), colors->end(), name) == colors->end() &&
                   lower_case(part_of(name)) != "a";
        };
        if (std::none_of(names.begin(), names.end(), is_extra)) return *colors;
    }
    if (names.size() > 3)
        throw Error(fmt::format("the layer '{}' of {} has {} channels, and at most 3 can be compared", layer,
                                name_of(side), names.size()));
    std::sort(names.begin(), names.end());
    return names;
}

// In the order of preference.
void find_variances(const Image& image, const std::string& layer, const Names& parts, ChosenChannels& chosen)
{
    struct Rule {
        std::string prefix;
        VarianceKind kind;
    };
    const std::array<Rule, 3> rules =
        layer.empty() ? std::array<Rule, 3>{{{"variance.", VarianceKind::of_mean},
                                             {"Variance.", VarianceKind::of_sample},
                                             {"m2_", VarianceKind::second_moment}}}
                      : std::array<Rule, 3>{{{"variance_of_" + layer + ".", VarianceKind::of_mean},
                                             {"Variance." + layer + ".", VarianceKind::of_sample},
                                             {"m2_" + layer + ".", VarianceKind::second_moment}}};
    for (const Rule& rule : rules) {
        const auto places = find_channels(image, prefixed(rule.prefix, parts));
        if (!places) continue;
        chosen.variances = *places;
        chosen.kind = rule.kind;
        chosen.variance_name = rule.prefix + "*";
        return;
    }
}

// Mitsuba's integrator moment writes the moments of X, Y and Z beside the colours R, G and B: then the luminance has
// error bars, and they have none.
std::optional<ChosenChannels> luminance_with_moments(const Image& image)
{
    std::optional<ChosenChannels> result;
    for (const std::string& layer : layers_of(image)) {
        const auto place =
            find_channels(image, {layer + ".Y", "m2_" + layer + ".Y", layer + ".X", layer + ".Z"});
        if (!place) continue;
        if (result) return {};
        result.emplace();
        result->names = {"Y"};
        result->values = {(*place)[0]};
        result->variances = {(*place)[1]};
        result->kind = VarianceKind::second_moment;
        result->is_luminance = true;
        result->variance_name = "m2_" + layer + ".Y";
    }
    return result;
}

} // namespace

std::string layer_of(const std::string& channel)
{
    const std::size_t dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

std::string part_of(const std::string& channel)
{
    return channel.substr(channel.rfind('.') + 1);
}

std::vector<std::string> layers_of(const Image& image)
{
    Names layers;
    for (const std::string& name : image.channel_names())
        if (const std::string layer = layer_of(name);
            !layer.empty() && std::find(layers.begin(), layers.end(), layer) == layers.end())
            layers.push_back(layer);
    return layers;
}

std::vector<std::string> color_channels(const Image& image)
{
    if (const auto colors = colors_behind(image, "")) return *colors;
    if (find_channels(image, {"Y"})) return {"Y"};
    const std::string main = main_layer(image);
    return main.empty() ? Names() : *colors_behind(image, main + ".");
}

std::string header_text(const Image& image, std::string_view name)
{
    for (const auto& [key, value] : image.metadata) {
        if (key != name) continue;
        if (const auto* text = std::get_if<std::string>(&value)) return *text;
        if (const int* number = std::get_if<int>(&value)) return std::to_string(*number);
        if (const float* number = std::get_if<float>(&value)) return fmt::format("{}", *number);
    }
    return {};
}

ChosenChannels choose_channels(const Image& image, Side side, const std::string& layer,
                               bool samples_are_known)
{
    ChosenChannels chosen;
    if (!layer.empty()) {
        chosen.names = channels_of_layer(image, side, layer);
        chosen.values = *find_channels(image, chosen.names);
        Names parts;
        for (const std::string& name : chosen.names) parts.push_back(part_of(name));
        find_variances(image, layer, parts, chosen);
        return chosen;
    }
    const auto take = [&](const Names& names, const Names& channels, const std::string& of_layer) {
        chosen.names = names;
        chosen.values = *find_channels(image, channels);
        Names parts;
        for (const std::string& name : channels) parts.push_back(part_of(name));
        find_variances(image, of_layer, parts, chosen);
        if (const auto found = find_channels(image, {"contributing"}); found && of_layer.empty())
            chosen.contributing = found->front();
        return chosen;
    };
    const Names rgb = {"R", "G", "B"};
    if (const auto colors = colors_behind(image, "")) {
        take(rgb, *colors, "");
        if (chosen.variances.empty() && samples_are_known)
            if (auto luminance = luminance_with_moments(image)) return *luminance;
        return chosen;
    }
    if (find_channels(image, {"Y"})) return take({"Y"}, {"Y"}, "");
    if (const std::string main = main_layer(image); !main.empty())
        return take(rgb, *colors_behind(image, main + "."), main);
    const Names layers = layers_of(image);
    throw Error(fmt::format(
        "{} has neither the channels R, G and B nor Y, but {}; {}", name_of(side),
        fmt::join(image.channel_names(), ", "),
        layers.empty() ? "only these can be compared"
                       : fmt::format("choose a layer with --layer NAME: {}", fmt::join(layers, ", "))));
}

bool has_layer(const Image& image, const std::string& layer)
{
    const Names& names = image.channel_names();
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return !layer.empty() && layer_of(name) == layer; });
}

bool is_layer_of_colors(const Image& image, const std::string& layer)
{
    return has_layer(image, layer) && colors_behind(image, layer + ".").has_value();
}

bool has_colors(const Image& image)
{
    return colors_behind(image, "").has_value();
}

NoiseFacts noise_facts(const Image& image, const CompareSettings& options)
{
    NoiseFacts facts;
    const auto number = [&image](const char* name) -> std::optional<double> {
        const std::string text = header_text(image, name);
        double value = 0.0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (text.empty() || problem != std::errc() || end != text.data() + text.size()) return {};
        return std::isfinite(value) && value >= 1.0 && value <= 1e15 ? std::optional(value) : std::nullopt;
    };
    facts.samples = number("plumb:samplesPerPixel");
    facts.is_ours = facts.samples.has_value();
    if (!facts.samples) facts.samples = number("samplesPerPixel"); // pbrt-v4
    if (!facts.samples) facts.samples = options.samples;
    if (const auto replicas = number(replicas_mark); replicas && *replicas >= 2.0 && *replicas <= 1e6)
        facts.replicas = static_cast<int>(*replicas);
    facts.inflation = number(inflation_mark).value_or(1.0);
    return facts;
}

VarianceKind variance_kind(const ChosenChannels& chosen, const NoiseFacts& facts,
                           const CompareSettings& options)
{
    if (facts.replicas || (facts.is_ours && chosen.kind == VarianceKind::of_mean))
        return VarianceKind::of_mean;
    if (chosen.kind == VarianceKind::second_moment || !options.variance_of) return chosen.kind;
    return *options.variance_of == VarianceOf::mean ? VarianceKind::of_mean : VarianceKind::of_sample;
}

} // namespace plumb
