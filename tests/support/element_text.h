// SPDX-License-Identifier: MIT
#pragma once

#include "scene_file/document.h"

#include <fmt/format.h>

namespace plumb::test {

// A tree as text, without places.
inline std::string text_of(const Element& element)
{
    std::string text = "<" + element.tag;
    for (const Attribute& attribute : element.attributes)
        text += fmt::format(" {}='{}'", attribute.name, attribute.value);
    if (element.children.empty()) return text + "/>";
    text += ">";
    for (const Element& child : element.children) text += text_of(child);
    return text + fmt::format("</{}>", element.tag);
}

} // namespace plumb::test
