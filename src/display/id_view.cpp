// SPDX-License-Identifier: MIT
#include "display/id_view.h"

#include "base/lower_case.h"
#include "base/visible_text.h"
#include "compare/channel_names.h"
#include "plumb/image/false_color.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace plumb {

namespace {

std::string names_of(const Image& image, const std::string& channel)
{
    return header_text(image, "plumb:ids." + layer_of(channel));
}

// A line each: "3 floor.obj".
std::map<int, std::string> table_of(const std::string& lines)
{
    std::map<int, std::string> names;
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', begin), lines.size());
        const std::string line = lines.substr(begin, end - begin);
        const std::size_t blank = std::min(line.find(' '), line.size());
        names.emplace(std::atoi(line.c_str()), line.substr(std::min(blank + 1, line.size())));
        begin = end + 1;
    }
    return names;
}

std::string hex_text(const Color& color)
{
    const auto byte = [](float x) { return static_cast<int>(srgb_from_linear(x) * 255.f + 0.5f); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color.r), byte(color.g), byte(color.b));
}

} // namespace

bool is_of_ids(const Image& image, const std::string& channel)
{
    return lower_case(part_of(channel)) == "id" || !names_of(image, channel).empty();
}

Color id_color(int id)
{
    if (id == 0) return Color();
    // Hue and lightness by a sequence that fills the plane evenly: Roberts 2018, "The Unreasonable Effectiveness of
    // Quasirandom Sequences", R2.
    constexpr double step_of_hue = 0.7548776662466927, step_of_lightness = 0.5698402909980532;
    constexpr double full_turn = 0x1.921fb54442d18p+2;
    const auto part = [id](double step) {
        const double x = step * static_cast<double>(id);
        return x - std::floor(x);
    };
    const SinCosD hue = sin_cos(full_turn * part(step_of_hue));
    constexpr double chroma = 0.12;
    const Vec3d rgb = linear_srgb({0.55 + 0.3 * part(step_of_lightness), chroma * hue.cos, chroma * hue.sin});
    const auto channel = [](double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); };
    return {channel(rgb.x), channel(rgb.y), channel(rgb.z)};
}

ImageView view_ids(const Image& image, std::size_t place)
{
    const std::string& channel = image.channel_names()[place];
    const PixelRect& window = image.data_window();
    ImageView view{Image(window, image.full_width(), image.full_height()), {}, {}};
    std::map<int, std::size_t> pixels;
    std::size_t odd = 0;
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const float value = image.pixel(x, y)[place];
            constexpr float most = 1e9f;
            const bool is_id = value >= 0.f && value <= most;
            const int id = is_id ? static_cast<int>(std::lround(value)) : 0;
            if (is_id)
                ++pixels[id];
            else
                ++odd;
            const Color color = is_id ? id_color(id) : not_finite_color;
            for (int i = 0; i < 3; ++i) view.image.pixel(x, y)[i] = color[i];
        }
    }
    std::map<int, std::string> names = table_of(names_of(image, channel));
    names.emplace(0, "nothing");
    view.legend.push_back(fmt::format("{}: {} ids", channel, pixels.size()));
    for (const auto& [id, count] : pixels) {
        const auto name = names.find(id);
        view.legend.push_back(fmt::format("  {} {} {} pixels{}{}", hex_text(id_color(id)), id, count,
                                          name == names.end() ? "" : " ",
                                          name == names.end() ? "" : visible_text(name->second)));
    }
    if (odd > 0) view.legend.push_back(fmt::format("{} pixels have no id: green", odd));
    return view;
}

} // namespace plumb
