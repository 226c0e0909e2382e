// SPDX-License-Identifier: MIT
#pragma once

// <include>, <default> and $name: what a scene file means once they are replaced.

#include "scene_file/document.h"

#include <map>

namespace plumb {

struct Expansion {
    Element root;                                       // no <include>, <default> or $name is left
    std::vector<std::shared_ptr<const TextFile>> files; // in the order of reading, the main one first
};

using Definitions = std::map<std::string, std::string, std::less<>>;

// root: of the main file. A definition (-D) wins over every <default> of that name, the first <default> over later
// ones; they apply to the whole scene, wherever they stand, except that the values of <default> and the file names
// of <include> know only what precedes them. In a <test> or a <suite> they stand in it or in its scenes or groups, and
// apply to all of it.
Expansion expand(Element root, const Definitions& definitions, Diagnostics& diagnostics);

} // namespace plumb
