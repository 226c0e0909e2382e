// SPDX-License-Identifier: MIT
#include "check/surface_triangles.h"

namespace plumb {

Vec3d SurfaceTriangles::front(std::size_t i) const
{
    const TriangleEdges edges = corners(i).edges();
    const Vec3f normal(normalize(triangle_cross(edges)));
    const Ray ray{triangle_point(edges, {1.0 / 3.0, 1.0 / 3.0}) + normal, -normal};
    return Vec3d(shape_->surface_at(ray, static_cast<std::uint32_t>(i)).geometric_normal);
}

} // namespace plumb
