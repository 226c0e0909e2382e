// SPDX-License-Identifier: MIT
#pragma once

// A text file that appears whole or not at all.

#include <filesystem>
#include <string_view>

namespace plumb {

// Throws Error if `path` cannot be written. Leaves nothing behind and touches no file that is there.
void check_text_path(const std::filesystem::path& path);

// Writes beside `path` and renames. What is neither a file nor absent (a pipe, a terminal) is written to directly.
void write_text_file(const std::filesystem::path& path, std::string_view text);

// With those above it, if it is not there. Throws Error.
void make_directory(const std::filesystem::path& directory);

} // namespace plumb
