// SPDX-License-Identifier: MIT
#pragma once

// What other renderers and other forks of the courses' code call things, and what to do instead.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace plumb {

struct ForeignName {
    std::string_view kind;   // of object; "tag": the name of an element
    std::string_view name;   // upper and lower case, blanks, - and _ make no difference
    std::string_view ours;   // what it is called here; empty: there is no such thing
    std::string_view advice; // then
};

inline constexpr std::string_view vacuum_only = "Plumb renders surfaces in a vacuum only";

std::span<const ForeignName> foreign_names();

// "integrator 'mipath' is 'path_mis' here", "bsdf 'coating' is not supported; use 'roughsubstrate'"; nothing for other
// names.
std::optional<std::string> foreign_type(std::string_view kind, std::string_view name);
// "<rgb> is <color> here", "<medium> is not supported; Plumb renders surfaces in a vacuum only".
std::optional<std::string> foreign_tag(std::string_view tag);

} // namespace plumb
