// SPDX-License-Identifier: MIT

// The files of a race.

#include "base/text_file.h"
#include "compare/false_color_image.h"
#include "plumb/math/elementary.h"
#include "plumb/reports/race_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

// "path_mis with sobol" -> "path_mis_with_sobol".
std::string file_name(std::string name)
{
    std::replace_if(
        name.begin(), name.end(),
        [](char c) {
            return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                     c == '.');
        },
        '_');
    return name;
}

std::string map_file(const fs::path& directory, const std::string& name, const char* extension)
{
    return (directory / fmt::format("efficiency_{}{}", file_name(name), extension)).string();
}

std::vector<float> values_of(const Image& map)
{
    std::vector<float> values;
    const PixelRect& window = map.data_window();
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x) values.push_back(map.pixel(x, y)[0]);
    return values;
}

// One for all maps, so that they can be compared by eye: logarithmic, but for one pixel in 100 at either end.
struct LogRange {
    double low = 1.0;
    double high = 10.0;
};
LogRange range_of(const RaceResult& race)
{
    std::vector<float> all;
    for (const RaceRow& row : race.ranking)
        if (row.efficiency_map)
            for (const float value : values_of(*row.efficiency_map))
                if (value > 0.f) all.push_back(value);
    if (all.empty()) return {};
    std::sort(all.begin(), all.end());
    const std::size_t tail = all.size() / 100;
    const auto low = static_cast<double>(all[tail]);
    return {low, std::max(static_cast<double>(all[all.size() - 1 - tail]), low * 10.0)};
}

Image map_image(const Image& map, const LogRange& range)
{
    std::vector<float> values = values_of(map);
    for (float& value : values)
        value = value > 0.f ? static_cast<float>(log(static_cast<double>(value) / range.low) /
                                                 log(range.high / range.low))
                            : std::nanf("");
    return false_color_image(values, map.data_window().width, map.data_window().height,
                             {fmt::format("{:.1e}", range.low),
                              fmt::format("{:.1e}", std::sqrt(range.low * range.high)),
                              fmt::format("{:.1e}", range.high)});
}

} // namespace

std::vector<std::string> race_files(const fs::path& directory, const std::vector<std::string>& names)
{
    std::vector<std::string> files = {(directory / "convergence.csv").string(),
                                      (directory / "convergence.svg").string()};
    for (const std::string& name : names)
        for (const char* extension : {".exr", ".png"}) files.push_back(map_file(directory, name, extension));
    return files;
}

void write_race_details(const fs::path& directory, const std::string& scene, const RaceResult& race)
{
    write_text_file(directory / "convergence.csv", convergence_csv(race));
    write_text_file(directory / "convergence.svg", convergence_svg(scene, race));
    const LogRange range = range_of(race);
    for (const RaceRow& row : race.ranking) {
        if (!row.efficiency_map) continue;
        write_image(map_file(directory, row.name, ".exr"), *row.efficiency_map);
        write_image(map_file(directory, row.name, ".png"), map_image(*row.efficiency_map, range));
    }
}

} // namespace plumb
