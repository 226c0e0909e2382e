// SPDX-License-Identifier: MIT
#pragma once

// What kind of surface a shape is.

#include "plumb/model/shape.h"

#include <vector>

namespace plumb {

// Its two ends: x, y, z and x, y, z, the smaller end first. The same bits wherever the positions are the same numbers.
using Edge = std::array<float, 6>;

struct MeshFacts {
    // Each edge has two triangles; triangles without area do not count. Spheres are closed.
    bool is_closed = false;
    // Those that have not, each once, sorted.
    std::vector<Edge> open_edges;
    // Of a closed surface, positive if its front looks outwards.
    double volume = 0.0;
};

MeshFacts mesh_facts(const Shape& shape);

} // namespace plumb
