// SPDX-License-Identifier: MIT
#pragma once

// Triangles of a mesh as lights: one, and eight side by side.

#include "plumb/model/light_lanes.h"
#include "plumb/shapes/mesh.h"

#include <array>
#include <span>

namespace plumb {

struct Facet {
    std::array<Vec3f, 3> corners;
    Vec3f normal; // of the front (shape.h), unit length; zero where there is no area
    double area = 0.0;
};
Facet facet_of(const MeshData& mesh, std::uint32_t triangle);

// Up to eight of them. unit: the area of intensity 1.
LightLanes lanes_of(const MeshData& mesh, std::span<const std::uint32_t> triangles,
                    const LightLanes::Space& space, double unit);

} // namespace plumb
