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

// What programs that make trees of files can be made to choke on.
struct XmlLimits {
    std::size_t depth = 64;        // levels
    std::size_t attributes = 256;  // of an element
    std::size_t parts = 4'000'000; // elements and attributes of a file
};

// The first thing that is wrong with the text as XML with one root element, within limits. Parsers forgive some of it,
// say less of the rest, and may recurse once a level.
std::optional<XmlError> scan_xml(std::string_view text, const XmlLimits& limits);

// The name of the root element, or of what the text shows of it; empty where something else comes first.
std::string_view root_tag(std::string_view text);

} // namespace plumb
