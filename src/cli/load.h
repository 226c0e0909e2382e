// SPDX-License-Identifier: MIT
#pragma once

// Opening scenes, and saying what was found.

#include "plumb/rendering/task.h"

#include <memory>
#include <string>

namespace plumb {

// Throws Error, or UsageError if it looks like a misspelled verb.
std::unique_ptr<SceneFile> open_scene(const std::string& file, const SceneSettings& settings);

// Its warnings and its dialect; verbose: and facts about it.
void log_scene(const RenderTask& task, bool verbose);

} // namespace plumb
