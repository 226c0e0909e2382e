// SPDX-License-Identifier: MIT
#pragma once

// In Mitsuba's files a <ref> may name any object. Plumb's own are for BSDFs, textures and groups.

#include "scene_file/document.h"

namespace plumb {

// Puts a copy of what it names in the place of each <ref> to an emitter, film, filter, sampler, integrator or spectrum, and
// leaves out those that stand directly in the scene only to be named. Ids are unique already. most_parts: how many elements
// and attributes the copies may have together.
void place_copies(Element& root, std::size_t most_parts, Diagnostics& diagnostics);

} // namespace plumb
