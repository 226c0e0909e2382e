// SPDX-License-Identifier: MIT
#pragma once

// How text looks on a terminal: colours and the width of lines. Pure functions of the text.

#include <string>
#include <string_view>

namespace plumb {

// What is said to standard error, as it looks where there are colours: "error:" is red, the place before it and 'names' are
// bold. Without the escape sequences it is the same text.
std::string with_colors(std::string_view text);

// Text that was written for 80 columns, for a terminal with another number of them: lines of a paragraph that end for lack
// of room are joined, and long ones are broken between words. Indented lines keep their indent; those with a column of
// names and one of explanations (two spaces or more between them) keep both.
std::string rewrapped(std::string_view text, int columns);

} // namespace plumb
