// SPDX-License-Identifier: MIT
#pragma once

// Text of unknown origin (file names, what files contain) made fit for terminals, logs and reports.

#include <cstddef>
#include <string>
#include <string_view>

namespace plumb {

// The length of the well-formed UTF-8 sequence at the front (Unicode 15, table 3-7); 0 if there is none.
std::size_t utf8_length(std::string_view text);

char32_t code_point(std::string_view character); // of a well-formed sequence

// Whether a well-formed sequence is a character that steers a terminal or the layout of a line instead of showing:
// control characters (C0, DEL, C1), line and paragraph separators, marks that change the direction of writing.
bool steers(std::string_view character);

// One line of valid UTF-8 that steers nothing: such characters as \x1b or \u202e, bytes that are no UTF-8 as \xff. What
// the command line prints of anybody's text goes through here: console.h.
std::string visible_text(std::string_view text);

// Valid UTF-8: what is not becomes U+FFFD.
std::string valid_utf8(std::string_view text);

} // namespace plumb
