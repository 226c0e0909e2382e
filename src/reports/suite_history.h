// SPDX-License-Identifier: MIT
#pragma once

// The verdicts of earlier runs of a suite: history.json, an array with a line for each run.

#include "plumb/experiments/suite_run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

// The lines of the file, the oldest first; nothing where it cannot be read. They may be anything.
std::vector<std::string> read_history(const std::filesystem::path& file);
// Those, with one of this run behind them; only the newest are kept. seconds: since 1970.
std::vector<std::string> with_run(std::vector<std::string> history, const SuiteRun& run,
                                  std::uint64_t seconds);
std::string history_json(const std::vector<std::string>& history);

} // namespace plumb
