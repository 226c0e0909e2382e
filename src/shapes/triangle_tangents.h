// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/intersection.h"
#include "plumb/shape.h"

namespace plumb {

// The derivatives of the position by uv, which are linear over the triangle. Where they are those of a line or a point, and
// there is no derivative: by the barycentric coordinates, which are the edges.
inline Tangents triangle_tangents(const TriangleEdges& e, const Vec2f& uv0, const Vec2f& uv1,
                                  const Vec2f& uv2)
{
    const auto difference = [&](const Vec2f& to) {
        return Imath::V2d(to.x - static_cast<double>(uv0.x), to.y - static_cast<double>(uv0.y));
    };
    const Imath::V2d a = difference(uv1), b = difference(uv2);
    const double scale = 1.0 / (a.x * b.y - a.y * b.x);
    const Tangents by_uv{Vec3f((e.edge1 * b.y - e.edge2 * a.y) * scale),
                         Vec3f((e.edge2 * a.x - e.edge1 * b.x) * scale)};
    if (is_finite(by_uv.dp_du) && is_finite(by_uv.dp_dv)) return by_uv;
    return {Vec3f(e.edge1), Vec3f(e.edge2)};
}

} // namespace plumb
