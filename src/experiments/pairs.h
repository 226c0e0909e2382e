// SPDX-License-Identifier: MIT
#pragma once

// What agree() and race() share.

#include "plumb/experiments/agree.h"

namespace plumb {

// Of each method. What one of them cannot be is said with its name.
std::vector<RenderTask> tasks_of(SceneFile& file, const AgreeSettings& settings, int threads);

// Throws Error if somebody stops it.
RenderState render_all(const RenderTask& task, const SessionCallbacks& callbacks);

// Of one sample of every pixel, by a few.
double seconds_per_sample(RenderTask task);

// All pairs, with the significance of all of them together.
Agreement compare_pairs(std::vector<Estimate> estimates, std::vector<std::uint64_t> samples_of,
                        const CompareSettings& how);

} // namespace plumb
