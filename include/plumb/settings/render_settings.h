// SPDX-License-Identifier: MIT
#pragma once

// What an image is made from. Nothing here says where files are written or how many threads there are: these belong to
// a run, and settings may come from a file.

#include "plumb/image/image.h"
#include "plumb/model/dialect.h"
#include "plumb/render/light_split.h"
#include "plumb/scene/instruction_set.h"
#include "plumb/settings/settings.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

// What is absent is as the scene file says.
struct SceneSettings {
    std::map<std::string, std::string> definitions = {}; // of $name
    std::optional<DialectName> dialect = {};
    std::optional<bool> emitters_absorb = {};
    std::optional<bool> mirrored_view = {};
    std::optional<float> environment_scale = {}; // from 0
    bool lenient = false;                        // unknown parameters are warnings
    friend bool operator==(const SceneSettings&, const SceneSettings&) = default;
};

struct MethodSettings {
    std::optional<std::string> integrator = {}; // type names
    std::optional<std::string> sampler = {};
    std::string instruction_set{default_instruction_set().name}; // one of instruction_sets()
    friend bool operator==(const MethodSettings&, const MethodSettings&) = default;
};

struct ViewSettings {
    std::optional<Vec2i> size = {}; // pixels
    std::optional<PixelRect> crop = {};
    std::vector<std::string> aovs = {};  // names of layers: aovs.h
    std::vector<LightSplit> splits = {}; // more layers: light_split.h
    friend bool operator==(const ViewSettings&, const ViewSettings&) = default;
};

struct SampleSettings {
    std::optional<std::uint64_t> per_pixel = {}; // from 1 to film_max_samples
    std::uint64_t seed = 0;
    // Each pixel decides how many of them it gets, by this target error: adaptive.h.
    std::optional<double> adaptive = {};
    friend bool operator==(const SampleSettings&, const SampleSettings&) = default;
};

// When a rendering ends besides the number of samples: stop_rules.h.
struct StopSettings {
    std::optional<double> seconds = {}; // for all images of a run together
    std::optional<double> relative_error = {};
    friend bool operator==(const StopSettings&, const StopSettings&) = default;
};

struct OutputSettings {
    Development development = {}; // of .png and .jpg
    bool denoise = false;         // .png and .jpg; adds layers to the image
    bool error_bars = true;       // .exr files also have the variance of each pixel
    friend bool operator==(const OutputSettings&, const OutputSettings&) = default;
};

struct RenderSettings {
    SceneSettings scene = {};
    MethodSettings method = {};
    ViewSettings view = {};
    SampleSettings samples = {};
    StopSettings stop = {};
    OutputSettings output = {};
    friend bool operator==(const RenderSettings&, const RenderSettings&) = default;
};

template <>
std::span<const SettingRow<RenderSettings>> setting_rows<RenderSettings>();

} // namespace plumb
