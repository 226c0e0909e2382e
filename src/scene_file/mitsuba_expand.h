// SPDX-License-Identifier: MIT
#pragma once

#include "scene_file/expand.h"

namespace plumb {

// As expand(), by Mitsuba's rules: <include> may stand anywhere and include any object; $name is replaced wherever a known
// name follows a $, the longest first, and only after its <default>; <path> says where files are looked for; <alias> gives a
// second id. An id that is given twice is an error.
Expansion expand_mitsuba(Element root, const Definitions& definitions, Diagnostics& diagnostics,
                         const ExpansionLimits& limits = {});

} // namespace plumb
