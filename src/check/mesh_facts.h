// SPDX-License-Identifier: MIT
#pragma once

// What kind of surface a shape is.

#include "plumb/shape.h"

namespace plumb {

struct MeshFacts {
    // Each edge has two triangles, wherever positions are the same bits; triangles without area do not count. Spheres are
    // closed.
    bool is_closed = false;
    // Of a closed surface, positive if its front looks outwards.
    double volume = 0.0;
};

MeshFacts mesh_facts(const Shape& shape);

} // namespace plumb
