// SPDX-License-Identifier: MIT
#pragma once

// A first look at an XML file, before the parser: is it well-formed, and how deep?

#include <optional>
#include <string>
#include <string_view>

namespace plumb {

struct XmlError {
    std::size_t offset = 0;
    std::size_t length = 1;
    std::string message;
};

// The first thing that is wrong with the text as XML with one root element and at most max_depth levels. Parsers
// forgive some of it, say less of the rest, and may recurse once a level.
std::optional<XmlError> scan_xml(std::string_view text, int max_depth);

} // namespace plumb
