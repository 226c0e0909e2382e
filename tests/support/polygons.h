// SPDX-License-Identifier: MIT
#pragma once

// Polygons of many kinds, all of them counter-clockwise and without crossings, for tests of cutting them.

#include "plumb/math/math.h"
#include "support/random.h"

#include <vector>

namespace plumb::test {

using Polygon = std::vector<Vec2f>;

// Corners at random distances around (0, 0).
Polygon star_polygon(int corners, TestRandom& random);
// Two chains from left to right, of which the upper one stays above.
Polygon monotone_polygon(int corners, TestRandom& random);
// Teeth on a bar of this height; 0: the gaps reach down to the lower edge and touch it.
Polygon comb_polygon(int corners, float bar);
// A band that winds inwards; as wide as the gap beside it.
Polygon spiral_polygon(int corners);
// Petals that all touch in (0, 0).
Polygon flower_polygon(int corners);
// A bar with square or round holes in it. From each to the next the boundary runs there and back again.
Polygon holed_polygon(int holes, int corners_of_a_hole);

// With corners between those that it has, on its edges.
Polygon with_collinear_corners(const Polygon& polygon, TestRandom& random);
Polygon with_doubled_corners(const Polygon& polygon, TestRandom& random);

double area_of(const Polygon& polygon);
bool contains(const Polygon& polygon, double x, double y); // an odd number of edges to the right of it
double distance_to_boundary(const Polygon& polygon, double x, double y);

} // namespace plumb::test
