// SPDX-License-Identifier: MIT
#pragma once

// Cutting the polygons of an OBJ file into triangles.

#include "plumb/math/math.h"
#include "shapes/obj/polygon_ears.h"

#include <span>
#include <vector>

namespace plumb {

// The sum of the cross products of consecutive corners (Newell's method): along the normal, twice the area long.
Vec3d newell_normal(std::span<const Vec3f> polygon);

// Triangles with the polygon's orientation, appended to `triangles`. Polygons should be planar, or nearly so, and
// simple, but for what cut_polygon() allows; others are cut in some way. Convex ones become a fan about their first
// corner, so a quad a b c d becomes a b c and a c d. Concave ones lose ears, in their plane.
void triangulate_polygon(std::span<const Vec3f> polygon, std::vector<PolygonTriangle>& triangles);

} // namespace plumb
