// SPDX-License-Identifier: MIT
#include "cli/render_request.h"

#include "base/shell_words.h"
#include "plumb/scene_file/scene_file.h"

#include <fmt/format.h>

namespace plumb {

namespace {

using Row = SettingRow<RenderSettings>;

std::string option_text(const Row& row, const RenderSettings& settings)
{
    std::string text;
    for (const std::string& value : row.get(settings)) {
        text += fmt::format(" --{}", row.name);
        if (!row.is_switch()) text += " " + shell_quote(value);
    }
    return text;
}

} // namespace

RenderOptions render_options(const RenderSettings& settings, int threads)
{
    RenderOptions options;
    options.samples_per_pixel = settings.samples.per_pixel.value_or(0);
    options.seed = settings.samples.seed;
    options.threads = threads;
    options.crop = settings.view.crop;
    options.aovs = settings.view.aovs;
    return options;
}

std::string options_text(const RenderSettings& settings)
{
    std::string text;
    for (const Row& row : setting_rows<RenderSettings>()) text += option_text(row, settings);
    return text;
}

std::string replay_options_text(const RenderSettings& settings)
{
    std::string text;
    for (const Row& row : setting_rows<RenderSettings>())
        // The samples of some samplers depend on how many there are.
        if (row.effect == Effect::samples || row.name == "spp") text += option_text(row, settings);
    return text;
}

} // namespace plumb
