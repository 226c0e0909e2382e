// SPDX-License-Identifier: MIT
#pragma once

// Taking a picture's samples: from a checkpoint or from the start, until a stop rule or a signal says so.

#include "cli/options.h"

#include "plumb/render.h"

namespace plumb {

struct RenderRun {
    RenderState state;
    std::string stop; // why before all samples that were asked for (Evidence::stop); empty if all are taken
    int signal = 0;   // that ended it; 0: none
    std::string problem; // why the last checkpoint could not be written; empty: it was, or none is asked for
};

// Shows progress. Writes checkpoints as often as the options ask, and the last one at the end; one that cannot be written is
// a warning, but for the last. header: work_header() of it. Throws Error if it cannot begin.
RenderRun run_rendering(const Options& options, const LoadedScene& scene, const Metadata& header);

} // namespace plumb
