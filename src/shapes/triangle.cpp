// SPDX-License-Identifier: MIT

#include "shapes/triangle.h"

namespace plumb {

double edge_margin(const TriangleEdges& t, double clearance)
{
    double extents = 0.0;
    for (int i = 0; i < 3; ++i)
        extents += std::max({t.edge1[i], t.edge2[i], 0.0}) - std::min({t.edge1[i], t.edge2[i], 0.0});
    return 2.0 * clearance * extents / length(triangle_cross(t));
}

Vec3f point_off_edges(const TriangleEdges& t, const Barycentric& b, double clearance)
{
    const Vec3d normal = triangle_cross(t);
    const double normal_length = length(normal);
    Vec3d p = t.corner + t.edge1 * b.u + t.edge2 * b.v;
    // coordinate: of the corner opposite to the edge, 0 on the edge.
    const auto leave = [&](const Vec3d& edge, double coordinate) {
        const double edge_length = length(edge);
        const double move = clearance - 0.5 * coordinate * normal_length / edge_length;
        if (move > 0.0) p += cross(normal, edge) * (move / (normal_length * edge_length));
    };
    if (normal_length > 0.0) {
        leave(t.edge1, b.v);
        leave(t.edge2 - t.edge1, 1.0 - b.u - b.v);
        leave(-t.edge2, b.u);
    }
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

} // namespace plumb
