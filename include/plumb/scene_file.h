// SPDX-License-Identifier: MIT
#pragma once

// Reading a scene file.

#include "plumb/dialect.h"
#include "plumb/error.h"
#include "plumb/instruction_set.h"
#include "plumb/render.h"

#include <filesystem>
#include <map>
#include <string>

namespace plumb {

// What the command line changes of a scene.
struct LoadOptions {
    std::optional<DialectName>
        dialect; // nothing: the file's dialect attribute, else the evidence in the file
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
    std::uint64_t texture_bytes = 0; // of the pictures in textures
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
