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

LoadOptions load_options(const SceneRequest& request)
{
    const RenderSettings& settings = request.settings;
    LoadOptions load;
    load.dialect = settings.scene.dialect;
    load.emitters_absorb = settings.scene.emitters_absorb;
    load.mirrored_view = settings.scene.mirrored_view;
    load.environment_scale = settings.scene.environment_scale;
    load.definitions = settings.scene.definitions;
    load.integrator = settings.method.integrator;
    load.sampler = settings.method.sampler;
    load.samples_per_pixel = settings.samples.per_pixel;
    load.resolution = settings.view.size;
    load.instruction_set = settings.method.instruction_set;
    load.lenient = settings.scene.lenient;
    if (const auto& crop = settings.view.crop)
        load.kept_pixels = static_cast<std::uint64_t>(crop->width) * static_cast<std::uint64_t>(crop->height);
    if (request.one_pixel) load.kept_pixels = 1;
    return load;
}

RenderOptions render_options(const RenderSettings& settings, int threads)
{
    RenderOptions options;
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
