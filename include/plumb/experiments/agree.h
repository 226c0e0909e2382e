// SPDX-License-Identifier: MIT
#pragma once

// One scene rendered by several methods: whether they agree.

#include "plumb/compare/compare.h"
#include "plumb/rendering/session.h"
#include "plumb/scene_file/scene_file.h"

#include <optional>
#include <string>
#include <vector>

namespace plumb {

struct AgreeSettings {
    RenderSettings base;                 // view and samples; its time limit is for all images together
    std::vector<MethodSettings> methods; // two or more
    CompareSettings how = {};            // the significance is that of all pairs together
};

// "path_mis with sobol"; without a sampler, "path_mis".
std::string method_name(const MethodSettings& method);

struct MethodPair {
    std::size_t a = 0, b = 0; // of the estimates
    Comparison comparison;
};

struct Agreement {
    std::vector<Estimate> estimates;       // an image by each method
    std::vector<std::uint64_t> samples_of; // of a pixel, in all, by each method
    std::vector<MethodPair> pairs;         // all
    Verdict verdict = Verdict::undecided;
};

// Each method has random numbers of its own. Throws Error if callbacks.stop ends it.
Agreement agree(SceneFile& file, const AgreeSettings& settings, int threads = 0,
                const SessionCallbacks& callbacks = {});

} // namespace plumb
