// SPDX-License-Identifier: MIT
#pragma once

// Scenes written in a test: the text goes to a file in a temporary directory and through the real loader.

#include "plumb/scene/scene.h"
#include "plumb/scene_file/scene_file.h"
#include "support/temp_directory.h"

#include <string>

namespace plumb::test {

inline LoadedScene load_text(const std::string& xml, const RenderSettings& options = {})
{
    const TempDirectory directory;
    return load_scene(directory.write("scene.xml", xml), options);
}

// What loading complains of.
inline std::string errors(const std::string& xml, const RenderSettings& options = {})
{
    try {
        load_text(xml, options);
        return {};
    } catch (const SceneError& error) {
        return error.what();
    }
}

// A camera of 8 x 6 pixels, and how a scene with it starts.
inline const std::string camera = "<camera type='perspective'><integer name='width' value='8'/>"
                                  "<integer name='height' value='6'/></camera>";
inline const std::string start = "<scene dialect='plumb'><integrator type='normals'/>" + camera;

} // namespace plumb::test
