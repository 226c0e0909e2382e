// SPDX-License-Identifier: MIT
#include "plumb/rendering/task.h"

#include "base/visible_text.h"

#include <algorithm>

namespace plumb {

namespace {

// Headers have no absolute paths.
std::string name_of(const std::filesystem::path& file)
{
    const auto path = file.lexically_normal();
    return valid_utf8((path.is_absolute() ? path.filename() : path).generic_string());
}

// What guides the denoiser is a layer like any other, and said in the header.
RenderSettings with_guides(RenderSettings settings)
{
    std::vector<std::string>& aovs = settings.view.aovs;
    if (settings.output.denoise)
        for (const char* guide : {"albedo_behind", "normal_behind"})
            if (std::find(aovs.begin(), aovs.end(), guide) == aovs.end()) aovs.emplace_back(guide);
    return settings;
}

} // namespace

std::vector<std::string> aovs_of(const ViewSettings& view, const LoadedScene& scene)
{
    std::vector<std::string> aovs = view.aovs;
    for (const std::string& aov : scene.aovs)
        if (std::find(aovs.begin(), aovs.end(), aov) == aovs.end()) aovs.push_back(aov);
    return aovs;
}

RenderTask make_task(SceneFile& file, const RenderSettings& given)
{
    const RenderSettings settings = with_guides(given);
    RenderTask task{
        file.path().string(), name_of(file.path()), file.load(settings.method, settings.view), settings, {}};
    task.settings.scene = file.settings();
    task.options.samples_per_pixel = settings.samples.per_pixel.value_or(0);
    task.options.seed = settings.samples.seed;
    task.options.adaptive = settings.samples.adaptive;
    task.options.crop = settings.view.crop;
    task.options.aovs = aovs_of(settings.view, task.scene);
    task.options.splits = settings.view.splits;
    task.options.samples_per_pixel = render_samples(task.scene.job, task.options);
    return task;
}

} // namespace plumb
