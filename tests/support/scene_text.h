// SPDX-License-Identifier: MIT
#pragma once

// Scenes written in a test: the text goes to a file in a temporary folder and through the real loader.

#include "plumb/scene_file.h"
#include "support/temp_folder.h"

#include <fstream>
#include <string>

namespace plumb::test {

inline LoadedScene load_text(const std::string& xml, const LoadOptions& options = {})
{
    const TempFolder folder;
    const std::filesystem::path path = folder.path() / "scene.xml";
    std::ofstream(path) << xml;
    return load_scene(path, options);
}

} // namespace plumb::test
