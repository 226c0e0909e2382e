// SPDX-License-Identifier: MIT
#pragma once

// Files of other programs that are given to us as scenes.

#include "scene_file/document.h"

namespace plumb {

// What a file is if its first bytes show that it is no XML of ours: "this is an image (OpenEXR), not a scene; ...".
// Nothing for other files.
std::optional<std::string> foreign_content(std::string_view text);

// What is wrong with a scene of another renderer whose files look like ours, and where one sees it.
std::optional<Diagnostic> foreign_scene(const Element& root);

} // namespace plumb
