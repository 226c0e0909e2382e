// SPDX-License-Identifier: MIT
#pragma once

// One function a verb. They print, and return the program's exit code; they throw UsageError, or Error and SceneError for
// what is wrong with the input.

#include "cli/report.h"
#include "cli/requests.h"

namespace plumb {

int render_command(const RenderRequest& request);
int new_command(const std::string& file, bool quiet);
int types_command(const std::string& name); // empty: all
int info_command(const std::string& image);
int replay_command(const ReplayRequest& request);
int rerun_command(const RerunRequest& request);
int merge_command(const MergeRequest& request);
int check_command(const SceneRequest& request);
int help_command(const std::string& verb); // empty: all of them
int compare_command(const CompareRequest& request);
int agree_command(const EstimatorRequest& request);
int race_command(const RaceRequest& request);
int test_command(const TestRequest& request);
int batch_command(const BatchRequest& request);

// What became of a rendering.
struct Rendered {
    Report report;
    SampleSet::Range samples; // of a pixel
    int signal = 0;           // that ended it; 0: none
};

// Renders a loaded scene, and writes pictures, checkpoint and report.
Rendered render_and_write(const RenderRequest& request, const LoadedScene& scene);

// Says unless --quiet what render_and_write() did, and returns the exit code.
int log_rendering(const RenderRequest& request, const Rendered& rendered);

// Logs its dialect and its warnings unless --quiet.
LoadedScene load_and_log(const SceneRequest& request);

} // namespace plumb
