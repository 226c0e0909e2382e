// SPDX-License-Identifier: MIT
#pragma once

// What `renderer agree` and `renderer race` are asked for.

#include "cli/verb_file.h"

#include "plumb/experiments/race.h"

namespace plumb {

struct MethodsOptions : VerbOptions {
    RenderSettings settings;
    std::vector<std::string> integrators = {"path", "path_nee", "path_mis"};
    std::vector<std::string> samplers; // none: the scene's
    CompareSettings how;
    int threads = 0;
    std::string json;

    // Of a race.
    std::uint64_t rounds = 16;
    std::vector<RaceCommand> commands;
    bool allow_commands = false;
    double timeout = RaceCommand().timeout;
    std::string directory; // for curves, maps and the work of commands; empty: none
    std::string reference; // file; empty: none
};

// Each integrator with each sampler. Throws UsageError if there are fewer than two, and if --time and --spp are given both.
std::vector<MethodSettings> methods_of(const MethodsOptions& options, std::string_view verb);
// Says what loading with the first method has found, and throws what the others have.
std::unique_ptr<SceneFile> open_for(const MethodsOptions& options,
                                    const std::vector<MethodSettings>& methods);
void settle_methods(MethodsOptions& options);
// of_race: more options, between the methods and the time limit.
OptionTable<MethodsOptions> methods_options(const OptionTable<MethodsOptions>& of_race);

} // namespace plumb
