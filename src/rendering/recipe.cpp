// SPDX-License-Identifier: MIT
#include "plumb/rendering/recipe.h"

#include "base/text.h"
#include "rendering/origin.h"
#include "rendering/provenance.h"

#include "plumb/denoise/denoise.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// Those that the image has.
SampleSet samples_of(const Recipe& recipe, const PixelRect& window)
{
    const std::string image = recipe.image.string();
    const std::string name = "plumb:samplesTaken";
    const auto is_taken = [&](const auto& entry) { return entry.first == name; };
    const auto is_empty = [](const auto& entry) {
        return entry.first == "plumb:samplesPerPixel" && entry.second == MetadataValue(0);
    };
    // Where they are said, the smallest number of a pixel may be 0.
    if (std::none_of(recipe.header.begin(), recipe.header.end(), is_taken)) {
        if (std::any_of(recipe.header.begin(), recipe.header.end(), is_empty))
            throw Error(fmt::format(
                "'{}' has no samples: its rendering was interrupted before the first; resume it", image));
        if (const auto per_pixel = header_samples(recipe.header, "plumb:samplesPerPixel", image))
            return SampleSet(SampleBlock{window, 0, *per_pixel});
        throw Error(fmt::format("the header of '{}' does not say which samples it has", image));
    }
    const auto samples = SampleSet::from_text(header_text(recipe.header, name));
    if (!samples || samples->empty())
        throw Error(fmt::format("the header of '{}' is invalid: {} is not a set of samples", image, name));
    if (const SampleSet outside = *samples - SampleSet(SampleBlock{window, 0, film_max_samples});
        !outside.empty())
        throw Error(fmt::format(
            "the header of '{}' is invalid: {} has samples outside the image, the first of them at {}", image,
            name, SampleSet(outside.blocks().front()).text()));
    return *samples;
}

// Throws Error if a part of the scene means something else today than when the image was made.
void check_language(const Recipe& recipe, const LoadedScene& scene)
{
    const int was = language_of(recipe.header);
    if (was == language_version || (was == 1 && scene.changed_readings.empty())) return;
    const std::string what =
        scene.changed_readings.empty() ? "something in the scene" : list_text(scene.changed_readings);
    throw Error(fmt::format("cannot render '{}' again: it was made with version {} of the scene language, in "
                            "which {} had a different meaning than in version {}; render the scene itself",
                            recipe.image.string(), was, what, language_version));
}

// Throws Error with every file that is not what it was.
void check_inputs(const Metadata& then, const Metadata& now)
{
    std::vector<std::string> changes = input_changes(then, now);
    if (const std::string was = header_text(then, "plumb:dialect"), is = header_text(now, "plumb:dialect");
        was != is)
        changes.push_back(fmt::format("its dialect was {} and is {}", was, is));
    if (changes.empty() && header_text(then, "plumb:inputHash") != header_text(now, "plumb:inputHash"))
        changes.emplace_back("the dialect settings have changed");
    if (!changes.empty()) throw Error(fmt::format("the scene has changed: {}", list_text(changes)));
}

} // namespace

Recipe read_recipe(const std::filesystem::path& image)
{
    Recipe recipe;
    recipe.image = image;
    recipe.header = read_image(image, false).metadata;
    recipe.scene = header_text(recipe.header, "plumb:scene");
    recipe.stop = header_text(recipe.header, "plumb:stop");
    if (recipe.scene.empty() || header_text(recipe.header, "plumb:inputs").empty())
        throw Error(fmt::format("the header of '{}' does not say how the image was made; those of .exr files "
                                "rendered by Plumb do",
                                image.string()));
    if (const std::string how = denoised_text(recipe.header); !how.empty())
        throw Error(fmt::format("'{}' was denoised ({}); render the image again that it was made from",
                                image.string(), how));
    if (const std::string software = header_text(recipe.header, "Software");
        software != "Plumb " PLUMB_VERSION)
        throw Error(fmt::format("'{}' was rendered by '{}', and this is Plumb {}, whose images may differ",
                                image.string(), software, PLUMB_VERSION));
    if (has_old_hashes(recipe.header))
        throw Error(fmt::format("the header of '{}' identifies the scene's files by hashes of Plumb 0.1, not "
                                "by SHA-256, so they cannot be verified; render the scene itself",
                                image.string()));
    recipe.settings = header_settings(recipe.header, image.string());
    return recipe;
}

std::filesystem::path find_scene(const Recipe& recipe)
{
    const std::filesystem::path scene = recipe.scene;
    // Headers have no absolute paths, unless somebody else has written them.
    if (scene.is_absolute())
        throw Error(fmt::format("the header of '{}' is invalid: plumb:scene is an absolute path, '{}'",
                                recipe.image.string(), recipe.scene));
    std::error_code ignored;
    for (const std::filesystem::path& path : {scene, recipe.image.parent_path() / scene})
        if (std::filesystem::exists(path, ignored)) return path;
    throw Error(fmt::format("scene file '{}' exists neither here nor beside '{}'; pass its path with --scene",
                            recipe.scene, recipe.image.string()));
}

RenderTask make_task(const Recipe& recipe, SceneFile& file)
{
    RenderTask task = make_task(file, recipe.settings);
    task.name = recipe.scene;
    return task;
}

SamplesAgain samples_again(const Recipe& recipe, const RenderTask& task)
{
    check_language(recipe, task.scene);
    check_inputs(recipe.header, scene_header(task));
    return {samples_of(recipe, render_window(task.scene.job, task.options)), recipe.stop};
}

Image rerun(const Recipe& recipe, const std::filesystem::path& scene_file, int threads,
            const SessionCallbacks& callbacks)
{
    SceneFile file(scene_file.empty() ? find_scene(recipe) : scene_file, recipe.settings.scene);
    const RenderTask task = make_task(recipe, file);
    RenderSession session(task, {.threads = threads, .again = samples_again(recipe, task)}, callbacks);
    session.run();
    return session.image();
}

} // namespace plumb
