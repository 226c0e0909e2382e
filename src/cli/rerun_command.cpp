// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/header.h"
#include "cli/manuals.h"
#include "cli/outputs.h"
#include "cli/provenance.h"
#include "cli/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// The header of a picture of ours, which says how it was made.
Metadata read_recipe(const std::string& image_file)
{
    Metadata recipe = read_image(image_file, false).metadata;
    if (header_text(recipe, "plumb:scene").empty() || header_text(recipe, "plumb:inputs").empty())
        throw Error(fmt::format("the header of '{}' does not say how the image was made; those of .exr files "
                                "rendered by Plumb do",
                                image_file));
    if (const std::string software = header_text(recipe, "Software"); software != "Plumb " PLUMB_VERSION)
        throw Error(fmt::format("'{}' was rendered by '{}', and this is Plumb {}, whose images may differ",
                                image_file, software, PLUMB_VERSION));
    if (has_old_hashes(recipe))
        throw Error(fmt::format("the header of '{}' identifies the scene's files by hashes of Plumb 0.1, not "
                                "by SHA-256, so they cannot be verified; render the scene itself",
                                image_file));
    return recipe;
}

// Where the scene file was: seen from this directory, or from the picture's.
std::string find_scene(const RerunRequest& run, const std::string& scene)
{
    if (!run.scene.empty()) return run.scene;
    // Headers have no absolute paths, unless somebody else has written them.
    if (std::filesystem::path(scene).is_absolute())
        throw Error(fmt::format("the header of '{}' is invalid: plumb:scene is an absolute path, '{}'",
                                run.image, scene));
    const std::filesystem::path beside = std::filesystem::path(run.image).parent_path() / scene;
    std::error_code ignored;
    for (const std::filesystem::path& path : {std::filesystem::path(scene), beside})
        if (std::filesystem::exists(path, ignored)) return path.string();
    throw Error(fmt::format("scene file '{}' exists neither here nor beside '{}'; pass its path with --scene",
                            scene, run.image));
}

// What made the picture, with what is said of this run.
RenderRequest request_of(const Metadata& recipe, const RerunRequest& run)
{
    const std::string scene = header_text(recipe, "plumb:scene");
    RenderRequest request;
    request.settings = header_settings(recipe, run.image);
    request.scene = find_scene(run, scene);
    request.repeat = {scene, {}, header_text(recipe, "plumb:stop")};
    request.outputs = run.outputs;
    request.json = run.json;
    request.quiet = run.quiet;
    request.verbose = run.verbose;
    request.threads = run.threads;
    return request;
}

// Those that the picture has.
SampleSet samples_of(const Metadata& recipe, const PixelRect& window, const std::string& image_file)
{
    const auto per_pixel = header_samples(recipe, "plumb:samplesPerPixel", image_file);
    const std::string name = "plumb:samplesTaken";
    const auto is_taken = [&](const auto& entry) { return entry.first == name; };
    if (std::none_of(recipe.begin(), recipe.end(), is_taken)) {
        if (per_pixel) return SampleSet(SampleBlock{window, 0, *per_pixel});
        throw Error(fmt::format("the header of '{}' does not say which samples it has", image_file));
    }
    const auto samples = SampleSet::from_text(header_text(recipe, name));
    if (!samples || samples->empty())
        throw Error(
            fmt::format("the header of '{}' is invalid: {} is not a set of samples", image_file, name));
    if (const SampleSet outside = *samples - SampleSet(SampleBlock{window, 0, film_max_samples});
        !outside.empty())
        throw Error(fmt::format(
            "the header of '{}' is invalid: {} has samples outside the image, the first of them at {}",
            image_file, name, SampleSet(outside.blocks().front()).text()));
    return *samples;
}

// Throws Error if a part of the scene means something else today than when the picture was made.
void check_language(const Metadata& recipe, const LoadedScene& scene, const std::string& image_file)
{
    const int was = language_of(recipe);
    if (was == language_version || (was == 1 && scene.changed_readings.empty())) return;
    const std::string what =
        scene.changed_readings.empty() ? "something in the scene" : list_text(scene.changed_readings);
    throw Error(fmt::format("cannot render '{}' again: it was made with version {} of the scene language, in "
                            "which {} had a different meaning than in version {}; render the scene itself",
                            image_file, was, what, language_version));
}

// Throws Error with every file that is not what it was.
void check_inputs(const Metadata& recipe, const Metadata& now)
{
    std::vector<std::string> changes = input_changes(recipe, now);
    if (const std::string was = header_text(recipe, "plumb:dialect"), is = header_text(now, "plumb:dialect");
        was != is)
        changes.push_back(fmt::format("its dialect was {} and is {}", was, is));
    if (changes.empty() && header_text(recipe, "plumb:inputHash") != header_text(now, "plumb:inputHash"))
        changes.emplace_back("the dialect settings have changed");
    if (!changes.empty()) throw Error(fmt::format("the scene has changed: {}", list_text(changes)));
}

} // namespace

std::string_view rerun_manual()
{
    return R"(Renders an image again from its header, to the same file, byte for byte.
The scene file is looked up relative to the current directory, and then to the
directory of the image. If the scene file, a mesh, an image or this program has
changed, the error names it.
)";
}

int rerun_command(const RerunRequest& run)
{
    const Metadata recipe = read_recipe(run.image);
    refuse_overwriting_inputs(KeptFiles({run.image}), run.outputs, run.json,
                              "it is the image to render again");
    check_outputs(run.outputs, run.json);
    RenderRequest request = request_of(recipe, run);
    const LoadedScene scene = load_and_log(request);
    check_language(recipe, scene, run.image);
    check_inputs(recipe, scene_header(request, scene));
    request.repeat->samples = samples_of(
        recipe, render_window(scene.job, render_options(request.settings, request.threads)), run.image);
    return log_rendering(request, render_and_write(request, scene));
}

} // namespace plumb
