// SPDX-License-Identifier: MIT
#include "compare/estimate.h"

#include "plumb/base/error.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

std::optional<std::size_t> find_channel(const Image& image, const std::string& name)
{
    const std::vector<std::string>& names = image.channel_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return {};
    return static_cast<std::size_t>(found - names.begin());
}

// The places of all of them, in their order; nothing if one is missing.
std::optional<std::vector<std::size_t>> find_channels(const Image& image,
                                                      const std::vector<std::string>& names)
{
    std::vector<std::size_t> places;
    for (const std::string& name : names) {
        const auto place = find_channel(image, name);
        if (!place) return {};
        places.push_back(*place);
    }
    return places;
}

std::vector<float> read_channels(const Image& image, const std::vector<std::size_t>& places)
{
    const PixelRect& window = image.data_window();
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height) *
                   places.size());
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            for (const std::size_t place : places) values.push_back(image.pixel(x, y)[place]);
    return values;
}

std::optional<double> samples_per_pixel(const Image& image)
{
    for (const auto& [name, value] : image.metadata) {
        if (name != "plumb:samplesPerPixel") continue;
        if (const int* count = std::get_if<int>(&value); count && *count > 0) return *count;
        if (const float* count = std::get_if<float>(&value); count && *count >= 1.f && std::isfinite(*count))
            return static_cast<double>(*count);
    }
    return {};
}

const char* name_of(Side side)
{
    return side == Side::a ? "A" : "B";
}

// Red, green and blue in this order, others by their names.
std::vector<std::string> channels_of_layer(const Image& image, Side side, const std::string& layer)
{
    std::vector<std::string> names;
    std::vector<std::string> layers;
    for (const std::string& name : image.channel_names()) {
        const std::string of = name.substr(0, std::min(name.rfind('.'), name.size()));
        if (of == layer && name != layer) names.push_back(name);
        if (of != name && std::find(layers.begin(), layers.end(), of) == layers.end()) layers.push_back(of);
    }
    if (names.empty())
        throw Error(fmt::format("{} has no layer '{}'; it has {}", name_of(side), layer,
                                layers.empty() ? "none" : fmt::format("{}", fmt::join(layers, ", "))));
    if (names.size() > 3)
        throw Error(fmt::format("the layer '{}' of {} has {} channels, and at most 3 can be compared", layer,
                                name_of(side), names.size()));
    std::sort(names.begin(), names.end());
    if (names.size() == 3 && names.front() == layer + ".B" && names.back() == layer + ".R")
        std::swap(names.front(), names.back());
    return names;
}

// Empty if there is no such entry.
std::string header_text(const Image& image, std::string_view name)
{
    for (const auto& [key, value] : image.metadata) {
        if (key != name) continue;
        if (const auto* text = std::get_if<std::string>(&value)) return *text;
        if (const int* number = std::get_if<int>(&value)) return std::to_string(*number);
    }
    return {};
}

// The hash is of the scene's files and of what the command line makes of them.
std::string estimator_of(const Image& image)
{
    const std::string inputs = header_text(image, "plumb:inputHash");
    const std::string integrator = header_text(image, "plumb:integrator");
    return inputs.empty() || integrator.empty() ? "" : inputs + " " + integrator;
}

std::string size_text(const Picture& picture)
{
    const PixelRect& window = picture.window;
    std::string text = fmt::format("{}x{} pixels", picture.full_width, picture.full_height);
    if (window != PixelRect{0, 0, picture.full_width, picture.full_height})
        text += fmt::format(" of which {},{},{},{} exist", window.x, window.y, window.width, window.height);
    return text;
}

} // namespace

Color Picture::color(std::size_t pixel) const
{
    if (channels.size() == 1) return Color(value(pixel, 0));
    return {value(pixel, 0), value(pixel, 1), channels.size() > 2 ? value(pixel, 2) : 0.f};
}

bool Picture::is_finite(std::size_t pixel) const
{
    return plumb::is_finite(color(pixel));
}

bool Picture::variance_is_known(std::size_t pixel) const
{
    if (!knows_noise()) return false;
    for (std::size_t channel = 0; channel < channels.size(); ++channel) {
        const double v = variance(pixel, channel);
        if (!std::isfinite(v) || v < 0.0) return false;
    }
    return true;
}

ImageFacts facts_of_header(const Image& image)
{
    return {samples_per_pixel(image), estimator_of(image), header_text(image, "plumb:seed")};
}

Picture make_picture(const Image& image, ImageFacts facts, Side side, const std::string& layer)
{
    Picture picture;
    picture.estimator = std::move(facts.estimator);
    picture.seed = std::move(facts.seed);
    picture.window = image.data_window();
    picture.full_width = image.full_width();
    picture.full_height = image.full_height();
    if (!layer.empty()) {
        picture.channels = channels_of_layer(image, side, layer);
        picture.values = read_channels(image, *find_channels(image, picture.channels));
        return picture;
    }
    for (const std::vector<std::string>& names : {std::vector<std::string>{"R", "G", "B"}, {"Y"}}) {
        const auto places = find_channels(image, names);
        if (!places) continue;
        picture.channels = names;
        picture.values = read_channels(image, *places);
        std::vector<std::string> variances;
        for (const std::string& name : names) variances.push_back("variance." + name);
        if (const auto found = find_channels(image, variances))
            picture.variances = read_channels(image, *found);
        if (const auto found = find_channels(image, {"contributing"}))
            picture.contributing = read_channels(image, *found);
        picture.samples_per_pixel = facts.samples_per_pixel;
        return picture;
    }
    throw Error(
        fmt::format("{} has neither the channels R, G and B nor Y, but {}; only these can be compared",
                    name_of(side), fmt::join(image.channel_names(), ", ")));
}

bool are_of_one_estimator(const Picture& a, const Picture& b)
{
    return !a.estimator.empty() && a.estimator == b.estimator;
}

bool share_random_numbers(const Picture& a, const Picture& b)
{
    return are_of_one_estimator(a, b) && !a.seed.empty() && a.seed == b.seed;
}

void check_comparable(const Picture& a, const Picture& b)
{
    if (size_text(a) != size_text(b))
        throw Error(
            fmt::format("the images have different sizes: A is {}, B is {}", size_text(a), size_text(b)));
    if (a.channels != b.channels)
        throw Error(fmt::format("the images have different channels: A has {}, B has {}",
                                fmt::join(a.channels, ", "), fmt::join(b.channels, ", ")));
}

} // namespace plumb
