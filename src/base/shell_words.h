// SPDX-License-Identifier: MIT
#pragma once

// Words of a POSIX shell's command line.

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// As it is if harmless, else in single quotes; with what steers a terminal (visible_text.h) as in $'a\nb'.
std::string shell_quote(std::string_view word);
std::vector<std::string> shell_split(std::string_view line); // the words that shell_quote() made a line of

} // namespace plumb
