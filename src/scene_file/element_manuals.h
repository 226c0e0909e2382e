// SPDX-License-Identifier: MIT
#pragma once

// The manual of the elements of a scene file, as the types have theirs.

#include <span>
#include <string_view>

namespace plumb {

struct ElementManual {
    std::string_view names; // of the elements, the first of which heads the page: "transform translate scale"
    std::string_view text;

    std::string_view title() const;
    bool is_about(std::string_view name) const;
};

std::span<const ElementManual> element_manuals();

// The page about an element, or null.
const ElementManual* find_element_manual(std::string_view name);

} // namespace plumb
