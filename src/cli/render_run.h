// SPDX-License-Identifier: MIT
#pragma once

// Taking a picture's samples: from a checkpoint or from the start, until a stop rule or a signal says so.

#include "cli/render_request.h"

#include "plumb/scene_file/scene_file.h"

namespace plumb {

struct RenderRun {
    RenderState state;
    std::string stop; // why before all samples that were asked for (Evidence::stop); empty if all are taken
    int signal = 0;   // that ended it; 0: none
};

// Shows progress. Writes checkpoints as often as the options ask, but for the last; one that cannot be written is a warning.
// header: work_header() of it. An InterruptGuard must live. Throws Error if it cannot begin.
RenderRun run_rendering(const RenderRequest& request, const LoadedScene& scene, const Metadata& header);

// Writes the checkpoint that the options ask for. stop: as in RenderRun. Throws Error.
void save_run(const RenderRequest& request, const LoadedScene& scene, const RenderState& state,
              const std::string& stop, Metadata header);

} // namespace plumb
