// SPDX-License-Identifier: MIT
#pragma once

// Rendering an image again from its header.

#include "plumb/rendering/session.h"

#include <filesystem>
#include <string>

namespace plumb {

// What an image of ours says of how it was made.
struct Recipe {
    std::filesystem::path image;
    std::string scene; // the scene file, as the header has it: relative, or a name
    RenderSettings settings;
    std::string stop; // Evidence::stop
    Metadata header;
};

// Throws Error if the image does not say it, or if another version of the program has made it.
Recipe read_recipe(const std::filesystem::path& image);

// Where the scene file is: seen from this directory, or from the image's. Throws Error if it is in neither.
std::filesystem::path find_scene(const Recipe& recipe);

// The work that made the image, of a file that must be read with the recipe's settings of the scene.
RenderTask make_task(const Recipe& recipe, SceneFile& file);
// The samples that the image has. Throws Error if they are none of this task, with every input that is not what it was.
SamplesAgain samples_again(const Recipe& recipe, const RenderTask& task);

// All of it: the image, with the same bits. scene_file: empty, or where the scene is now.
Image rerun(const Recipe& recipe, const std::filesystem::path& scene_file = {}, int threads = 0,
            const SessionCallbacks& callbacks = {});

} // namespace plumb
