// SPDX-License-Identifier: MIT
#pragma once

// The files that a command writes: found out about before the work begins.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// Throws Error if one of the images or the JSON report cannot be written, UsageError if two are one file, under whatever
// names. json: as --json has it; empty: none; "-": standard output.
void check_outputs(const std::vector<std::string>& images, const std::string& json);

// Throws Error, "cannot write 'X': " and the reason, if an output is one of the inputs.
void keep_inputs(const std::vector<std::filesystem::path>& inputs, const std::vector<std::string>& images,
                 const std::string& json, std::string_view reason);

// Where --json says, if anywhere.
void write_json(const std::string& json, std::string_view text);

} // namespace plumb
