// SPDX-License-Identifier: MIT
#pragma once

// Doing what one entry of a suite says.

#include "cli/batch/result.h"
#include "cli/batch/state.h"
#include "cli/outputs.h"
#include "cli/requests.h"

#include <set>

namespace plumb {

struct BatchContext {
    const BatchRequest& request;
    std::filesystem::path directory;
    BatchState state;
    std::set<std::string> titles; // that are taken
    KeptFiles kept;               // that no picture may replace
};

// Throws Error.
void make_directory(const std::filesystem::path& directory);

// Renders the entry's picture unless it is up to date, and compares it. Never throws: what goes wrong is in the result.
BatchResult run_entry(const BatchJob& job, BatchContext& context);

// Makes a reference; the result says how that went.
BatchResult make_reference(const BatchJob& job, const BatchRequest& run, const KeptFiles& kept);

} // namespace plumb
