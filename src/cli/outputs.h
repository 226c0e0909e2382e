// SPDX-License-Identifier: MIT
#pragma once

// The files that a command writes: found out about before the work begins.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumb {

// By their names alone. others: options and what they name; empty: nothing; "-": standard output. Throws UsageError if an
// output has no name, or two have the same.
void check_output_names(const std::vector<std::string>& outputs,
                        const std::vector<std::pair<std::string_view, std::string>>& others);

// Throws Error if one of the images or the JSON report cannot be written, UsageError if two are one file, under whatever
// names. json: as --json has it; empty: none; "-": standard output.
void check_outputs(const std::vector<std::string>& images, const std::string& json);

// The images, and the report if it is a file.
std::vector<std::string> with_json(std::vector<std::string> images, const std::string& json);

// What follows --json, or stands behind --json=; empty: nothing does. For commands that failed: also a file that is there
// and is no JSON of ours is nothing, for it may be what the command refused to replace.
std::string json_destination_of_errors(const std::vector<std::string>& words);

// Where --json says, if anywhere.
void write_json(const std::string& json, std::string_view text);

} // namespace plumb
