// SPDX-License-Identifier: MIT

#include "check/mesh_facts.h"

#include "check/surface_triangles.h"
#include "plumb/model/shape.h"

#include <algorithm>

namespace plumb {

namespace {

Edge edge_between(const Vec3f& a, const Vec3f& b)
{
    const auto from_to = [](const Vec3f& p, const Vec3f& q) { // -0 becomes 0
        return Edge{p.x + 0.f, p.y + 0.f, p.z + 0.f, q.x + 0.f, q.y + 0.f, q.z + 0.f};
    };
    return std::min(from_to(a, b), from_to(b, a));
}

// Of every triangle that has an area, sorted.
std::vector<Edge> edges_of(const SurfaceTriangles& shape)
{
    std::vector<Edge> edges;
    edges.reserve(3 * shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const TriangleCorners t = shape.corners(i);
        if (!(length(triangle_cross(t.edges())) > 0.0)) continue;
        edges.insert(edges.end(),
                     {edge_between(t.p0, t.p1), edge_between(t.p1, t.p2), edge_between(t.p2, t.p0)});
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::vector<Edge> open_among(const std::vector<Edge>& edges)
{
    std::vector<Edge> open;
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last = std::upper_bound(first, edges.end(), *first);
        if (last - first != 2) open.push_back(*first);
        first = last;
    }
    return open;
}

// By the divergence theorem, from a point of the surface.
double volume_of(const SurfaceTriangles& shape)
{
    double volume = 0.0;
    const Vec3d from(shape.corners(0).p0);
    for (std::uint32_t i = 0; i < shape.size(); ++i) {
        const TriangleCorners triangle = shape.corners(i);
        const Vec3d normal = triangle_cross(triangle.edges());
        if (!(length(normal) > 0.0)) continue;
        const double side = dot(shape.front(i), normal) < 0.0 ? -1.0 : 1.0;
        volume += side * dot(Vec3d(triangle.p0) - from, normal) / 6.0;
    }
    return volume;
}

} // namespace

MeshFacts mesh_facts(const Shape& shape)
{
    const SurfaceTriangles triangles(shape);
    MeshFacts facts;
    if (triangles.ball()) {
        facts.is_closed = true;
        facts.volume = 1.0;
        return facts;
    }
    const std::vector<Edge> edges = edges_of(triangles);
    facts.open_edges = open_among(edges);
    facts.is_closed = !edges.empty() && facts.open_edges.empty();
    if (facts.is_closed) facts.volume = volume_of(triangles);
    return facts;
}

} // namespace plumb
