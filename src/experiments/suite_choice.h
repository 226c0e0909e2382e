// SPDX-License-Identifier: MIT
#pragma once

// Which files a run of a suite reads, and so must not replace.

#include "plumb/experiments/suite_run.h"

namespace plumb {

// Scenes, given images, inputs and, unless they are to be made, references.
std::vector<std::filesystem::path> files_to_keep(const std::filesystem::path& suite,
                                                 const std::vector<SuiteJob>& jobs, bool update);

} // namespace plumb
