// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace plumb {

// As the value of an attribute or as text. XML 1.0 has no control characters but these three, nor U+FFFE and U+FFFF
// (section 2.2); what shows it may be a terminal, which the others must not steer.
std::string xml_text(std::string_view text);

} // namespace plumb
