// SPDX-License-Identifier: MIT
#pragma once

// What to render: settings, which make the picture, and what belongs to this run alone.

#include "plumb/render/sample_set.h"
#include "plumb/settings/render_settings.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

struct RenderOptions;

// A scene to be loaded.
struct SceneRequest {
    std::string scene; // file
    RenderSettings settings;
    bool quiet = false;
    bool verbose = false;
};

struct CheckpointRequest {
    std::string file; // empty: none
    double every_seconds = 60.0;
    bool resume = false;
};

// One of the parts of a picture, from 0.
struct PartRequest {
    std::uint64_t index = 0;
    std::uint64_t count = 1;
    PartBy by = PartBy::tiles;
};

// A picture that is there, to be rendered again.
struct RepeatRequest {
    std::string scene; // what its header calls the scene
    SampleSet samples;
    std::string stop; // Evidence::stop
};

struct RenderRequest : SceneRequest {
    int threads = 0;                  // 0: all
    std::vector<std::string> outputs; // none: <scene>_<spp>.exr and .png
    std::string json;                 // empty: no report; "-": standard output
    bool keep_interrupted = true;     // write the picture although a signal ended the rendering
    CheckpointRequest checkpoint;
    std::optional<PartRequest> part;
    std::optional<RepeatRequest> repeat;
    std::string typed; // the words of the command line, quoted for a shell: " s.xml --seed 7"
};

// The settings in the words of the renderer.
RenderOptions render_options(const RenderSettings& settings, int threads);

// " --seed 7 --define 'a=b c'": the options that make these settings, quoted for a shell.
std::string options_text(const RenderSettings& settings);
// Those of them that `renderer replay` needs.
std::string replay_options_text(const RenderSettings& settings);

} // namespace plumb
