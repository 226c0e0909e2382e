// SPDX-License-Identifier: MIT
#pragma once

// Cutting polygons of any size into triangles, in about n log n.

#include "shapes/obj/plane_point.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

using PolygonTriangle = std::array<std::uint32_t, 3>; // numbers of corners

struct PolygonCut {
    std::vector<PolygonTriangle> triangles; // as many as corners, less two
    std::uint64_t steps = 0;                // a measure of the time it took that is the same on every run
};

// The area of those triangles that turn clockwise. Where it is 0, the triangles do not overlap and fill the polygon:
// they always add up to it, each counted with the sign of its area.
double folded_area(std::span<const PlanePoint> polygon, std::span<const PolygonTriangle> triangles);

// Of a counter-clockwise polygon without crossings; corners may be doubled or collinear, and its boundary may touch
// itself, or run there and back again, as it does to the holes in it. Others are cut in some way.
PolygonCut cut_polygon(std::span<const PlanePoint> polygon);

} // namespace plumb
