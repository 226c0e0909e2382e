// SPDX-License-Identifier: MIT
#pragma once

// What `renderer agree` and `renderer race` are asked for.

#include "cli/verb_file.h"

#include "plumb/experiments/agree.h"

namespace plumb {

struct MethodsOptions : VerbOptions {
    RenderSettings settings;
    std::vector<std::string> integrators = {"path", "path_nee", "path_mis"};
    std::vector<std::string> samplers; // none: the scene's
    CompareSettings how;
    std::uint64_t rounds = 16; // of a race
    int threads = 0;
    std::string json;
};

// Each integrator with each sampler. Throws UsageError if there are fewer than two, and if --time and --spp are given both.
std::vector<MethodSettings> methods_of(const MethodsOptions& options, std::string_view verb);
// Says what loading with the first method has found, and throws what the others have.
std::unique_ptr<SceneFile> open_for(const MethodsOptions& options,
                                    const std::vector<MethodSettings>& methods);
void settle_methods(MethodsOptions& options);
// rounds: the options between the methods and the time limit.
OptionTable<MethodsOptions> methods_options(const OptionTable<MethodsOptions>& rounds);

} // namespace plumb
