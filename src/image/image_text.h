// SPDX-License-Identifier: MIT
#pragma once

// Other libraries' error messages in our style.

#include <string>
#include <string_view>

namespace plumb {

// The text on one line: every run of blanks and line ends becomes a blank, and the full stop at the end goes.
std::string one_line(std::string_view text);

// The same for an error, which OpenImageIO and the loader of libraries say in strange words, or in none, where memory is
// short.
std::string reason_text(std::string_view text);

} // namespace plumb
