// SPDX-License-Identifier: MIT
#pragma once

// What one rendering is of.

#include "plumb/render/render.h"
#include "plumb/scene_file/scene_file.h"
#include "plumb/settings/render_settings.h"

#include <string>
#include <vector>

namespace plumb {

// Cheap to copy: what is large is shared.
struct RenderTask {
    std::string file; // of the scene, as it was given
    std::string name; // of the scene, in headers
    LoadedScene scene;
    RenderSettings settings;
    RenderOptions
        options; // of the settings; samples_per_pixel is settled: of the scene file where the settings have none
};

// The layers of the settings, then those of the scene's file that are not among them.
std::vector<std::string> aovs_of(const ViewSettings& view, const LoadedScene& scene);

// Denoising adds the layers that it needs. settings: those of the scene are the file's. Throws what SceneFile::load() throws.
RenderTask make_task(SceneFile& file, const RenderSettings& settings);

} // namespace plumb
