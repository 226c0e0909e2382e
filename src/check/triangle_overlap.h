// SPDX-License-Identifier: MIT
#pragma once

// Whether two triangles lie in each other.

#include "shapes/triangle.h"

#include <optional>

namespace plumb {

// What is asked of a triangle again and again.
struct FlatTriangle {
    explicit FlatTriangle(const TriangleCorners& t);

    std::array<Vec3d, 3> corners;
    Vec3d normal;     // of unit length; which side is the front is another question
    double area;      // 0: a triangle without one coincides with nothing
    double magnitude; // largest coordinate
    double size;      // largest extent along an axis
};

// The distance within which they count as lying in one plane, if they do and overlap.
std::optional<double> overlap_tolerance(const FlatTriangle& a, const FlatTriangle& b);

} // namespace plumb
