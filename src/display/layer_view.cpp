// SPDX-License-Identifier: MIT
#include "plumb/display/layer_view.h"

#include "compare/channel_names.h"
#include "display/id_view.h"
#include "display/shown_numbers.h"
#include "plumb/base/error.h"
#include "plumb/image/development.h"
#include "plumb/image/false_color.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plumb {

namespace {

using Names = std::vector<std::string>;

// The channels to show: of the image, of a layer, or one alone.
struct Chosen {
    Names names;
    std::vector<std::size_t> places;
    bool is_color = false;
};

bool are_parts(const Names& names, const char* parts)
{
    if (names.size() != std::string_view(parts).size()) return false;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (part_of(names[i]) != std::string(1, parts[i])) return false;
    return true;
}

// In the order in which they are colours: red, green and blue, or x, y and z; alpha is left out of colours.
void put_in_order(Names& names)
{
    const auto has = [&](const char* part) {
        return std::ranges::any_of(names, [&](const std::string& name) { return part_of(name) == part; });
    };
    const bool is_rgb = (has("R") && has("G") && has("B")) || (has("r") && has("g") && has("b"));
    std::ranges::sort(names);
    if (!is_rgb) return;
    std::erase_if(names,
                  [](const std::string& name) { return part_of(name) == "A" || part_of(name) == "a"; });
    std::ranges::reverse(names);
}

Names names_of_layer(const Image& image, const std::string& layer)
{
    const Names& all = image.channel_names();
    if (std::ranges::find(all, layer) != all.end()) return {layer};
    Names names;
    std::ranges::copy_if(all, std::back_inserter(names),
                         [&](const std::string& name) { return layer_of(name) == layer; });
    if (names.empty()) {
        const Names layers = layers_of(image);
        throw Error(fmt::format("the image has no layer or channel '{}'; its layers are {}, its channels {}",
                                layer, layers.empty() ? "none" : fmt::format("{}", fmt::join(layers, ", ")),
                                fmt::join(all, ", ")));
    }
    put_in_order(names);
    if (names.size() > 3)
        throw Error(
            fmt::format("the layer '{}' has {} channels, and at most 3 can be shown; choose one of {}", layer,
                        names.size(), fmt::join(names, ", ")));
    return names;
}

Chosen choose(const Image& image, const std::string& layer)
{
    Chosen chosen;
    chosen.names = layer.empty() ? color_channels(image) : names_of_layer(image, layer);
    if (chosen.names.empty())
        throw Error(fmt::format("the image has no colours; choose a layer or a channel with --layer: {}",
                                fmt::join(image.channel_names(), ", ")));
    chosen.is_color = layer.empty() || are_parts(chosen.names, "RGB") || are_parts(chosen.names, "rgb");
    for (const std::string& name : chosen.names)
        chosen.places.push_back(static_cast<std::size_t>(std::ranges::find(image.channel_names(), name) -
                                                         image.channel_names().begin()));
    return chosen;
}

// of(pixel): a number of each pixel, by rows.
template <class Of>
std::vector<float> numbers_of(const Image& image, const Of& of)
{
    const PixelRect& window = image.data_window();
    std::vector<float> numbers;
    numbers.reserve(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x) numbers.push_back(of(image.pixel(x, y)));
    return numbers;
}

// What a pixel of several channels is as one number.
struct OneNumber {
    std::string name;
    std::vector<float> values;
};

OneNumber one_number(const Image& image, const Chosen& chosen)
{
    const std::vector<std::size_t>& places = chosen.places;
    if (places.size() == 1)
        return {chosen.names[0], numbers_of(image, [&](const float* p) { return p[places[0]]; })};
    const std::string list = fmt::format("{}", fmt::join(chosen.names, ", "));
    if (chosen.is_color)
        return {"luminance of " + list, numbers_of(image, [&](const float* p) {
                    return luminance(Color(p[places[0]], p[places[1]], p[places[2]]));
                })};
    return {"length of " + list, numbers_of(image, [&](const float* p) {
                float sum = 0.f;
                for (const std::size_t place : places) sum += p[place] * p[place];
                return std::sqrt(sum);
            })};
}

ImageView empty_view(const Image& image, std::vector<std::string> channels = {"R", "G", "B"})
{
    return {Image(image.data_window(), image.full_width(), image.full_height(), std::move(channels)), {}, {}};
}

// Calls set(pixel of the view, number of the pixel).
template <class Set>
void for_each_pixel(Image& image, const Set& set)
{
    const PixelRect& window = image.data_window();
    std::size_t i = 0;
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x) set(image.pixel(x, y), i++);
}

void put(float* pixel, const Color& color)
{
    for (int channel = 0; channel < 3; ++channel) pixel[channel] = color[channel];
}

void note_not_finite(ImageView& view, std::size_t count)
{
    if (count > 0) view.legend.push_back(fmt::format("{} pixels are not finite: green", count));
}

ImageView view_colors(const Image& image, const Chosen& chosen, const ViewOptions& options)
{
    const bool is_grey = chosen.places.size() == 1;
    ImageView view = empty_view(image, is_grey ? Names{"Y"} : Names{"R", "G", "B"});
    view.development = options.development;
    for (std::size_t c = 0; c < chosen.places.size(); ++c) {
        const auto values = numbers_of(image, [&](const float* p) { return p[chosen.places[c]]; });
        for_each_pixel(view.image, [&](float* pixel, std::size_t i) { pixel[c] = values[i]; });
    }
    const std::string how = development_text(options.development);
    view.legend.push_back(
        fmt::format("{}: {}", fmt::join(chosen.names, ", "), how.empty() ? "white is 1" : how));
    return view;
}

ImageView view_numbers(const Image& image, const Chosen& chosen, const ViewOptions& options)
{
    const OneNumber numbers = one_number(image, chosen);
    const ShownNumbers shown(numbers.values, options.range, options.logarithmic);
    ImageView view = empty_view(image);
    std::size_t not_finite = 0;
    for_each_pixel(view.image, [&](float* pixel, std::size_t i) {
        const float value = numbers.values[i];
        const double place = std::isfinite(value) ? shown.place(value) : 0.0;
        const Color color =
            options.false_color ? false_color(place) : Color(linear_from_srgb(static_cast<float>(place)));
        put(pixel, std::isfinite(value) ? color : not_finite_color);
        not_finite += std::isfinite(value) ? 0 : 1;
    });
    view.legend.push_back(fmt::format("{}: {}", numbers.name,
                                      options.false_color ? shown.text(false_color_low, false_color_high)
                                                          : shown.text("black", "white")));
    note_not_finite(view, not_finite);
    return view;
}

// Directions are from -1 to 1 and texture coordinates mostly from 0 to 1, whatever values the image has of them.
std::optional<NumberRange> usual_range(const NumberRange& of_values)
{
    constexpr double rounding = 1e-4;
    if (of_values.high > 1.0 + rounding || of_values.low < -1.0 - rounding) return {};
    return of_values.low < -rounding ? NumberRange{-1.0, 1.0} : NumberRange{0.0, 1.0};
}

ImageView view_vectors(const Image& image, const Chosen& chosen, const ViewOptions& options)
{
    ImageView view = empty_view(image);
    std::vector<std::vector<float>> values;
    NumberRange of_all{infinity, -infinity};
    for (const std::size_t place : chosen.places) {
        values.push_back(numbers_of(image, [&](const float* p) { return p[place]; }));
        const NumberRange own = ShownNumbers(values.back(), {}, false).range();
        of_all = {std::min(of_all.low, own.low), std::max(of_all.high, own.high)};
    }
    const std::optional<NumberRange> range = options.range ? options.range : usual_range(of_all);
    std::vector<ShownNumbers> shown;
    constexpr const char* colors[] = {"red", "green", "blue"};
    for (std::size_t c = 0; c < values.size(); ++c) {
        shown.emplace_back(values[c], range, false);
        view.legend.push_back(fmt::format("{}: {:.6g} to {:.6g} as {}", chosen.names[c], shown[c].range().low,
                                          shown[c].range().high, colors[c]));
    }
    std::size_t not_finite = 0;
    for_each_pixel(view.image, [&](float* pixel, std::size_t i) {
        bool is_finite = true;
        for (std::size_t c = 0; c < values.size(); ++c) {
            is_finite = is_finite && std::isfinite(values[c][i]);
            pixel[c] = linear_from_srgb(static_cast<float>(shown[c].place(values[c][i])));
        }
        if (!is_finite) put(pixel, not_finite_color);
        not_finite += is_finite ? 0 : 1;
    });
    note_not_finite(view, not_finite);
    return view;
}

void check_options(const Chosen& chosen, bool is_of_ids, const ViewOptions& options)
{
    const std::string name =
        options.layer.empty() ? "the colours" : fmt::format("the layer '{}'", options.layer);
    const bool has_numbers =
        !is_of_ids && (options.false_color || (chosen.places.size() == 1 && !chosen.is_color));
    if (is_of_ids && options.false_color)
        throw Error(
            fmt::format("{} has ids, which have colours of their own: false colours are for numbers", name));
    if (options.logarithmic && !has_numbers)
        throw Error(
            fmt::format("a logarithmic scale is for numbers, not for {}; ask for false colours", name));
    if (options.range && !has_numbers && (is_of_ids || chosen.is_color))
        throw Error(
            fmt::format("a range is for numbers and vectors, not for {}; ask for false colours", name));
}

ImageView view_chosen(const Image& image, const Chosen& chosen, const ViewOptions& options)
{
    const bool has_ids = chosen.places.size() == 1 && is_of_ids(image, chosen.names[0]);
    check_options(chosen, has_ids, options);
    if (has_ids) return view_ids(image, chosen.places[0]);
    if (options.false_color) return view_numbers(image, chosen, options);
    if (chosen.is_color) return view_colors(image, chosen, options);
    return chosen.places.size() == 1 ? view_numbers(image, chosen, options)
                                     : view_vectors(image, chosen, options);
}

} // namespace

ImageView view_layer(const Image& image, const ViewOptions& options)
{
    const Chosen chosen = choose(image, options.layer);
    ImageView view = view_chosen(image, chosen, options);
    // Where the image comes from, but not how its own files for screens were developed.
    for (const auto& [name, value] : image.metadata)
        if (name == "Software" || (name.starts_with("plumb:") && name != "plumb:display" &&
                                   name != "plumb:set.exposure" && name != "plumb:set.tonemap"))
            view.image.metadata.emplace_back(name, value);
    const bool is_beauty = chosen.is_color && options.layer.empty() && !options.false_color;
    const std::string text = is_beauty ? development_text(options.development) : view.legend.front();
    for (Metadata::value_type& entry : display_header("", text))
        view.image.metadata.push_back(std::move(entry));
    return view;
}

} // namespace plumb
