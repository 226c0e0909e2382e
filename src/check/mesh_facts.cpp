// SPDX-License-Identifier: MIT

#include "check/mesh_facts.h"

#include "shapes/triangle.h"

#include <algorithm>

namespace plumb {

namespace {

// A shape as it describes itself to the acceleration structure.
class Description final : public AccelBuilder {
public:
    void add_triangles(std::span<const Vec3f> positions, std::span<const Triangle> triangles) override
    {
        positions_ = positions;
        triangles_ = triangles;
    }
    void add_sphere(const Vec3f&, float) override { has_sphere_ = true; }

    bool has_sphere() const { return has_sphere_; }
    std::size_t size() const { return triangles_.size(); }
    TriangleCorners triangle(std::size_t i) const
    {
        const Triangle& corners = triangles_[i];
        return {positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]};
    }

private:
    std::span<const Vec3f> positions_;
    std::span<const Triangle> triangles_;
    bool has_sphere_ = false;
};

Edge edge_between(const Vec3f& a, const Vec3f& b)
{
    const auto from_to = [](const Vec3f& p, const Vec3f& q) { // -0 becomes 0
        return Edge{p.x + 0.f, p.y + 0.f, p.z + 0.f, q.x + 0.f, q.y + 0.f, q.z + 0.f};
    };
    return std::min(from_to(a, b), from_to(b, a));
}

// Of every triangle that has an area, sorted.
std::vector<Edge> edges_of(const Description& shape)
{
    std::vector<Edge> edges;
    edges.reserve(3 * shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const TriangleCorners t = shape.triangle(i);
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

// The front of a triangle, asked of the shape where a ray meets its middle.
Vec3d front_of(const Shape& shape, const TriangleCorners& triangle, std::uint32_t primitive)
{
    const Vec3f normal(normalize(triangle_cross(triangle.edges())));
    const Ray ray{triangle_point(triangle.edges(), {1.0 / 3.0, 1.0 / 3.0}) + normal, -normal};
    return Vec3d(shape.surface_at(ray, primitive).geometric_normal);
}

// By the divergence theorem, from a point of the surface.
double volume_of(const Shape& shape, const Description& description)
{
    double volume = 0.0;
    const Vec3d from(description.triangle(0).p0);
    for (std::uint32_t i = 0; i < description.size(); ++i) {
        const TriangleCorners triangle = description.triangle(i);
        const Vec3d normal = triangle_cross(triangle.edges());
        if (!(length(normal) > 0.0)) continue;
        const double side = dot(front_of(shape, triangle, i), normal) < 0.0 ? -1.0 : 1.0;
        volume += side * dot(Vec3d(triangle.p0) - from, normal) / 6.0;
    }
    return volume;
}

} // namespace

MeshFacts mesh_facts(const Shape& shape)
{
    Description description;
    shape.add_to(description);
    MeshFacts facts;
    if (description.has_sphere()) {
        facts.is_closed = true;
        facts.volume = 1.0;
        return facts;
    }
    const std::vector<Edge> edges = edges_of(description);
    facts.open_edges = open_among(edges);
    facts.is_closed = !edges.empty() && facts.open_edges.empty();
    if (facts.is_closed) facts.volume = volume_of(shape, description);
    return facts;
}

} // namespace plumb
