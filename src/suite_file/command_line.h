// SPDX-License-Identifier: MIT
#pragma once

// Commands of a suite: words as a shell splits them, but no shell looks at them, and {names} in them.

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// Separated by white space; '...' and "..." keep it, and \ keeps the character behind it, but for '...'. Nothing else means
// anything. Throws Error if a quote is not closed.
std::vector<std::string> command_words(std::string_view command);

using Placeholders = std::map<std::string, std::string, std::less<>>;

// The names in braces, each once; {{ and }} are braces. Throws Error if one is not closed.
std::vector<std::string> placeholders_in(std::string_view text);
// With the values in their places. Throws Error for a name that has none.
std::string with_placeholders(std::string_view text, const Placeholders& values);

} // namespace plumb
