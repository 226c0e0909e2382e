// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/math.h"

namespace plumb {

// Where the width of a flat shape with this unit normal runs: along x projected onto its plane, or along z if the normal
// is parallel to x. Unit length.
inline Vec3d width_axis(const Vec3d& normal)
{
    constexpr double parallel_below = 1e-6; // sine of the angle between the normal and x
    const Vec3d projected = Vec3d(1.0, 0.0, 0.0) - normal * normal.x;
    return length(projected) > parallel_below ? normalize(projected) : Vec3d(0.0, 0.0, 1.0);
}

} // namespace plumb
