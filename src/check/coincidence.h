// SPDX-License-Identifier: MIT
#pragma once

// Surfaces that lie in each other: which of them a ray meets is left to chance, and a ray that starts on the one misses
// the other.

#include "plumb/scene/scene.h"

#include <vector>

namespace plumb {

// Where two surfaces coincide.
struct CoincidentPlace {
    Vec3f position{0.f};
    Vec3f front{0.f}; // unit normal of the first one's front; zero for spheres
};

// Two objects that coincide, or one that coincides with itself.
struct Coincidence {
    std::size_t first = 0; // of the objects given; first <= second
    std::size_t second = 0;
    bool faces_alike = true;             // else the one's front is where the other's back is
    std::uint64_t count = 0;             // pairs of triangles, or of spheres
    double tolerance = 0.0;              // the largest distance within which they counted as one
    std::vector<CoincidentPlace> places; // some of them, at least one
};

struct Coincidences {
    std::vector<Coincidence> found; // in the order of the objects
    bool is_complete = true;        // else there were too many triangles close together to look at them all
};

// Triangles coincide if they overlap, by more than a strip as wide as rounding, and the smaller one lies in the plane of
// the other, within what rounding does to coordinates of their size (16 roundings) or a millionth of the smaller one's
// size, whatever is more. Neighbours that share an edge or a corner do not overlap. Takes n log n time for n triangles
// that are a surface; a bound holds for others.
Coincidences find_coincidences(const std::vector<SceneObject>& objects);

} // namespace plumb
