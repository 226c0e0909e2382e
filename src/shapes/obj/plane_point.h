// SPDX-License-Identifier: MIT
#pragma once

// Points in a plane, and on which side of a line they lie.

#include <vector>

namespace plumb {

// Coordinates are floats: differences and products of two are then exact, or nearly so.
struct PlanePoint {
    double x;
    double y;
    friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

// Twice the signed area of a b c, rounded: positive if they turn counter-clockwise.
inline double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Its sign, exactly: -1, 0 or 1.
int turn_sign(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

} // namespace plumb
