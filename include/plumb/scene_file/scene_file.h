// SPDX-License-Identifier: MIT
#pragma once

// Reading a scene file.

#include "plumb/base/error.h"
#include "plumb/model/dialect.h"
#include "plumb/render/render.h"
#include "plumb/scene/instruction_set.h"

#include <filesystem>
#include <map>
#include <string>

namespace plumb {

// Of the scene language, for the headers of pictures. It grows when a file comes to mean something else than before:
//     1   up to Plumb 0.1, whose headers do not have it
//     2   `direction` of a directional light is where the light goes (but for mcgill); `delta` of a checkerboard counts
//         rectangles
inline constexpr int language_version = 2;

// What the command line changes of a scene.
struct LoadOptions {
    std::optional<DialectName>
        dialect; // nothing: the file's dialect attribute, else the evidence in it and in the files beside it
    std::optional<bool> emitters_absorb;
    std::optional<bool> mirrored_view;
    std::optional<float> environment_scale;
    std::map<std::string, std::string> definitions; // -D name=value
    std::optional<std::string>
        integrator; // replaces the scene's integrator by one of this type, default parameters
    std::optional<std::string> sampler;
    std::optional<std::uint64_t> samples_per_pixel;
    std::optional<Vec2i> resolution;
    std::optional<std::uint64_t> kept_pixels;                    // of a crop: only these must fit into memory
    std::string instruction_set{default_instruction_set().name}; // one of instruction_sets()
    bool lenient = false;                                        // unknown parameters are warnings
};

// A file that was read, and the hash of its bytes: 32 hex digits.
struct InputFile {
    std::filesystem::path path;
    std::string hash;
};

struct LoadedScene {
    RenderJob job;
    Dialect dialect;
    std::string integrator; // type names, for the header
    std::string sampler;
    std::vector<InputFile> inputs; // scene files, meshes, images
    std::string input_hash;        // of them all and of what options and dialect make of them; 32 hex digits
    std::vector<std::string> changed_readings; // what meant something else in version 1 of the language
    std::uint64_t texture_bytes = 0;           // of the pictures in textures
    std::vector<Diagnostic> warnings;
    double parse_seconds = 0.0; // XML, meshes and images
    double build_seconds = 0.0; // Embree
};

// Throws SceneError with everything that is wrong with the scene, or Error if the file cannot be read.
LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

// What the scene language knows, for `renderer types`.
struct TypeInfo {
    std::string_view kind;
    std::string_view name;
    std::string_view manual; // the doc block of the plugin
};
const std::vector<TypeInfo>& known_types();

} // namespace plumb
