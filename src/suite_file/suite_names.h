// SPDX-License-Identifier: MIT
#pragma once

// Names of files in a suite, which may be patterns, and lists of words.

#include "base/named_file.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

bool is_pattern(std::string_view text);
std::vector<std::string_view> words_of(std::string_view text); // separated by commas or white space

// A scene, or a pattern of scenes in one directory.
NamedFile find_scene(const std::filesystem::path& directory, const std::string& text);
std::vector<std::filesystem::path> matching_files(const std::filesystem::path& pattern); // sorted

// A file's name inside a directory that it must not leave.
bool is_inner_name(const std::string& name);

} // namespace plumb
