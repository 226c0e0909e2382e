// SPDX-License-Identifier: MIT
#pragma once

// The settings of an image in its header.
//
//     plumb:settings          the version of the schema, an integer
//     plumb:set.NAME          a setting that is not the default; the line ends and backslashes in its values are \n, \r
//                             and \\. One that may be repeated has a line for each value.
//
// A setting that is absent has the default of that schema: whoever changes a default or renames a setting makes a new
// schema, and fills in here what the older ones meant.
//     1   up to Plumb 0.1, without these entries: plumb:arguments has options of the command line, quoted for a shell
//     2   the entries above

#include "plumb/image/image.h"
#include "plumb/settings/render_settings.h"

namespace plumb {

inline constexpr int settings_schema = 2;

Metadata settings_header(const RenderSettings& settings);

// Those that a header has; it may come from anybody. Throws Error that begins with the name of the entry that is wrong.
RenderSettings settings_of_header(const Metadata& header);

// Whether the entry is one of the above.
bool is_settings_entry(std::string_view name);

} // namespace plumb
