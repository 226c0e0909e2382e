// SPDX-License-Identifier: MIT
#pragma once

// What is looked for in a scene that has been built.

#include "plumb/render/render.h"
#include "scene_file/document.h"

#include <string>
#include <vector>

namespace plumb {

struct Dialect;

// Warns of each directional light of the scene, which `root` describes, that reaches the front of no surface.
void warn_of_idle_suns(const Element& root, const RenderJob& job, const Dialect& dialect,
                       Diagnostics& diagnostics);

// What in the scene means something else than in version 1 of the scene language (language_version): "the direction of
// a directional light". Empty: nothing.
std::vector<std::string> readings_changed_since_1(const Element& root, const Dialect& dialect);

} // namespace plumb
