// SPDX-License-Identifier: MIT
#pragma once

// One function a verb. They print, and return the program's exit code; they throw UsageError, or Error and SceneError for
// what is wrong with the input.

#include "cli/options.h"
#include "cli/report.h"

namespace plumb {

int render_command(const Options& options);
int new_command(const Options& options);
int types_command(const Options& options);
int info_command(const Options& options);
int replay_command(const Options& options);
int rerun_command(const Options& options);
int merge_command(const Options& options);
int check_command(const Options& options);
int help_command(const Options& options);
int compare_command(const Options& options);
int agree_command(const Options& options);
int race_command(const Options& options);
int test_command(const Options& options);
int batch_command(const Options& options);

// What became of a rendering.
struct Rendered {
    Report report;
    SampleSet::Range samples; // of a pixel
    int signal = 0;           // that ended it; 0: none
};

// Renders a loaded scene, and writes pictures, checkpoint and report.
Rendered render_and_write(const Options& options, const LoadedScene& scene);

// Says unless --quiet what render_and_write() did, and returns the exit code.
int log_rendering(const Options& options, const Rendered& rendered);

// Loads the scene that the options name, and logs its dialect and its warnings unless --quiet.
LoadedScene load_and_log(const Options& options);

} // namespace plumb
