// SPDX-License-Identifier: MIT
#pragma once

// Cones of directions: all within an angle of an axis.

#include "plumb/math/math.h"

namespace plumb {

struct DirectionCone {
    Vec3f axis{0.f, 0.f, 1.f}; // unit length
    double angle = pi_d;       // in radians; pi: all directions
};

// A cone that holds both.
DirectionCone hull(const DirectionCone& a, const DirectionCone& b);

// The cone about an axis (any length) that holds the directions whose cosine with it is at least `cosine`. All
// directions, if the axis is zero.
DirectionCone cone_about(const Vec3d& axis, double cosine);

// The mean of a cosine, taken as 0 where it is negative, between the axis and the directions of the cone.
double mean_cosine(const DirectionCone& cone);

} // namespace plumb
