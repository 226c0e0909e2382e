// SPDX-License-Identifier: MIT
#pragma once

// One function a verb. They print; they throw UsageError, or Error and SceneError for what is wrong with the input.

#include "cli/options.h"

namespace plumb {

void render_command(const Options& options);
void types_command(const Options& options);
void info_command(const Options& options);
void replay_command(const Options& options);
void rerun_command(const Options& options);
int test_command(const Options& options);  // returns the exit code: 3 if a test failed
int agree_command(const Options& options); // the same
int check_command(const Options& options); // 3 if there are doubts
int compare_command(
    const Options& options); // returns the exit code: 3 if they differ, 4 if that is not known

// Renders a loaded scene, and writes pictures and report.
void render_and_write(const Options& options, const LoadedScene& scene);

// Loads the scene that the options name, and logs its dialect and its warnings unless --quiet.
LoadedScene load_and_log(const Options& options);

} // namespace plumb
