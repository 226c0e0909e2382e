// SPDX-License-Identifier: MIT
#pragma once

// A rendering with all that it writes and says: what `renderer` and `renderer rerun` share.

#include "cli/live_output.h"
#include "plumb/rendering/session.h"

#include <string>
#include <vector>

namespace plumb {

struct RenderFlow {
    SessionOptions session;
    std::vector<std::string> outputs; // images; none: <scene>_<spp>.exr and .png
    std::string json;                 // empty: no report; "-": standard output
    bool resume = false;
    bool quiet = false;
    LiveOptions live = {};
    std::string typed; // the words of the command line, to resume with
};

// Before the scene is loaded. Throws Error or UsageError.
void check_flow(const RenderFlow& flow);
// Returns the exit code.
int run_flow(const RenderTask& task, const RenderFlow& flow);

} // namespace plumb
