// SPDX-License-Identifier: MIT
#pragma once

// What the entries of a suite write beside their images: replicas, maps, the directory that a program works in.

#include "plumb/base/error.h"
#include "plumb/suite_file/suite.h"

namespace plumb {

// Adds an error for each entry whose title is what another one writes.
void check_written_files(const std::vector<SuiteEntry>& entries, Diagnostics& diagnostics);

} // namespace plumb
