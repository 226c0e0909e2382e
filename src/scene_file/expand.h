// SPDX-License-Identifier: MIT
#pragma once

// <include>, <default> and $name: what a scene file means once they are replaced.

#include "scene_file/document.h"
#include "scene_file/xml_scan.h"

#include <map>

namespace plumb {

struct Expansion {
    Element root;                                       // no <include>, <default> or $name is left
    std::vector<std::shared_ptr<const TextFile>> files; // in the order of reading, the main one first
};

// A small file could ask for very much by including others often, and by variables whose values have variables in them.
struct ExpansionLimits {
    std::size_t depth = 64; // of files that include each other
    std::size_t files = 1000;
    std::size_t text_size = max_text_size;             // of all files together, in bytes
    std::size_t parts = XmlLimits().parts;             // elements and attributes of all files together
    std::size_t value_size = std::size_t{1} << 20;     // of a value in which variables are replaced
    std::size_t replaced_size = std::size_t{64} << 20; // of all those values together
};

using Definitions = std::map<std::string, std::string, std::less<>>;

// root: of the main file. A definition (-D) wins over every <default> of that name, the first <default> over later
// ones; they apply to the whole scene, wherever they stand, except that the values of <default> and the file names
// of <include> know only what precedes them. In a <test> or a <suite> they stand in it or in its scenes or groups, and
// apply to all of it.
Expansion expand(Element root, const Definitions& definitions, Diagnostics& diagnostics,
                 const ExpansionLimits& limits = {});

} // namespace plumb
