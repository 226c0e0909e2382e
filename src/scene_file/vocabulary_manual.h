// SPDX-License-Identifier: MIT
#pragma once

// The tables of a dialect as text, for `renderer types --dialect NAME [TYPE]`.

#include "scene_file/vocabulary.h"

#include <optional>
#include <string>
#include <vector>

namespace plumb {

// Those that vocabulary_named() knows.
std::vector<std::string_view> vocabulary_names();
// "mitsuba3", "mitsuba06", or a course; null for other names.
const Vocabulary* vocabulary_named(std::string_view name);

// All types with what they are called here, then what is refused and what to do instead.
std::string types_of_vocabulary(const Vocabulary& words);
// Each parameter of a type of that name with what it is called here, how its value changes, and what it is if it is not
// given. Nothing for unknown types.
std::optional<std::string> manual_of_type(const Vocabulary& words, std::string_view type);

} // namespace plumb
