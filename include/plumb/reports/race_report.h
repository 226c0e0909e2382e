// SPDX-License-Identifier: MIT
#pragma once

// What race() found: for people, as JSON, and as files to look at and to compute with.

#include "plumb/experiments/race.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

// scene: its file, as it was given.
std::string race_text(const std::string& scene, const RaceResult& race);
std::string race_json(const std::string& scene, const RaceResult& race, const CompareSettings& how);

// Of RaceSettings::details. A line for each estimator and number of samples, below a line with the names of the columns.
std::string convergence_csv(const RaceResult& race);
// RMSE against samples, and against seconds.
std::string convergence_svg(const std::string& scene, const RaceResult& race);

// The files that write_race_details() writes: convergence.csv, convergence.svg, and efficiency_NAME.exr and .png for each.
std::vector<std::string> race_files(const std::filesystem::path& directory,
                                    const std::vector<std::string>& names);
// Throws Error if one cannot be written.
void write_race_details(const std::filesystem::path& directory, const std::string& scene,
                        const RaceResult& race);

} // namespace plumb
