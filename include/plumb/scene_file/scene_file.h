// SPDX-License-Identifier: MIT
#pragma once

// Reading a scene file.

#include "plumb/base/error.h"
#include "plumb/model/dialect.h"
#include "plumb/render/render.h"
#include "plumb/settings/render_settings.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace plumb {

// Of the scene language, for the headers of images. It grows when a file comes to mean something else than before:
//     1   up to Plumb 0.1, whose headers do not have it
//     2   `direction` of a directional light is where the light goes (but for mcgill); `delta` of a checkerboard counts
//         rectangles
inline constexpr int language_version = 2;

// A file that was read, and the hash of its bytes: 32 hex digits.
struct InputFile {
    std::filesystem::path path;
    std::string hash;
    bool is_jpeg = false; // by what it begins with
};

// A scene with a method and a view. Cheap to copy: what is large is shared.
struct LoadedScene {
    RenderJob job;
    Dialect dialect;
    std::string integrator; // type names, for the header
    std::string sampler;
    std::vector<std::string> aovs; // the layers that the file asks for, as in --aov
    std::vector<InputFile> inputs; // scene files, meshes, images
    std::string input_hash;        // of them all and of what options and dialect make of them; 32 hex digits
    std::vector<std::string> changed_readings; // what meant something else in version 1 of the language
    std::uint64_t texture_bytes = 0;           // of the images in textures
    std::vector<Diagnostic> warnings;
    double parse_seconds = 0.0; // XML, meshes and images
    double build_seconds = 0.0; // Embree
};

// A scene file, read and expanded once. It makes as many methods and views of its scene as wanted; they share the scene.
class SceneFile {
public:
    // Throws SceneError, or Error if the file cannot be read.
    explicit SceneFile(const std::filesystem::path& path, const SceneSettings& settings = {});
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;
    ~SceneFile();

    const std::filesystem::path& path() const { return path_; }
    const SceneSettings& settings() const;

    // The first call builds the scene, and so does one with another instruction set than the call before. Of a view with a
    // crop, only those pixels must fit into memory. Throws SceneError with everything that is wrong.
    LoadedScene load(const MethodSettings& method = {}, const ViewSettings& view = {});

private:
    LoadedScene load_with(const MethodSettings& method, const ViewSettings& view);

    struct Impl;
    std::filesystem::path path_;
    std::unique_ptr<Impl> impl_;
};

// Once, with what the settings say of scene, method and view.
LoadedScene load_scene(const std::filesystem::path& path, const RenderSettings& settings = {});

// What the scene language knows, for `renderer types`.
struct TypeInfo {
    std::string_view kind;
    std::string_view name;
    std::string_view manual; // the doc block of the plugin
};
const std::vector<TypeInfo>& known_types();

} // namespace plumb
