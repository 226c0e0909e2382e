// SPDX-License-Identifier: MIT

#include "check/mesh_facts.h"

#include <bit>
#include <map>
#include <unordered_map>

namespace plumb {

namespace {

struct PositionHash {
    std::size_t operator()(const Vec3f& p) const
    {
        std::uint64_t hash = 0;
        for (const float x : {p.x, p.y, p.z})
            hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0.f)) * 0x9E3779B97F4A7C15u; // -0 becomes 0
        return static_cast<std::size_t>(hash ^ hash >> 32);
    }
};

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
    std::span<const Triangle> triangles() const { return triangles_; }
    const Vec3f& corner(const Triangle& triangle, std::size_t i) const { return positions_[triangle[i]]; }

private:
    std::span<const Vec3f> positions_;
    std::span<const Triangle> triangles_;
    bool has_sphere_ = false;
};

Vec3d normal_of(const Description& shape, const AccelBuilder::Triangle& triangle)
{
    const Vec3d corner(shape.corner(triangle, 0));
    return cross(Vec3d(shape.corner(triangle, 1)) - corner, Vec3d(shape.corner(triangle, 2)) - corner);
}

// Each edge has exactly two triangles. Those without area have no edges.
bool is_closed(const Description& shape)
{
    std::unordered_map<Vec3f, std::uint32_t, PositionHash> vertices;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles_at;
    for (const AccelBuilder::Triangle& triangle : shape.triangles()) {
        if (!(length(normal_of(shape, triangle)) > 0.0)) continue;
        std::uint32_t index[3];
        for (std::size_t i = 0; i < 3; ++i)
            index[i] =
                vertices.emplace(shape.corner(triangle, i), static_cast<std::uint32_t>(vertices.size()))
                    .first->second;
        for (std::size_t i = 0; i < 3; ++i) ++triangles_at[std::minmax(index[i], index[(i + 1) % 3])];
    }
    return !triangles_at.empty() && std::all_of(triangles_at.begin(), triangles_at.end(),
                                                [](const auto& edge) { return edge.second == 2; });
}

// The front of a triangle, asked of the shape where a ray meets its middle.
Vec3d front_of(const Shape& shape, const Description& description, std::uint32_t primitive)
{
    const AccelBuilder::Triangle& triangle = description.triangles()[primitive];
    const Vec3d normal = normalize(normal_of(description, triangle));
    const Vec3d middle = (Vec3d(description.corner(triangle, 0)) + Vec3d(description.corner(triangle, 1)) +
                          Vec3d(description.corner(triangle, 2))) /
                         3.0;
    const Ray ray{Vec3f(middle + normal), Vec3f(-normal)};
    return Vec3d(shape.surface_at(ray, primitive).geometric_normal);
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
    facts.is_closed = is_closed(description);
    for (std::uint32_t i = 0; facts.is_closed && i < description.triangles().size(); ++i) {
        const AccelBuilder::Triangle& triangle = description.triangles()[i];
        const Vec3d normal = normal_of(description, triangle);
        if (!(length(normal) > 0.0)) continue;
        // The divergence theorem, from a point of the surface.
        const Vec3d from =
            Vec3d(description.corner(triangle, 0)) - Vec3d(description.corner(description.triangles()[0], 0));
        const double side = dot(front_of(shape, description, i), normal) < 0.0 ? -1.0 : 1.0;
        facts.volume += side * dot(from, normal) / 6.0;
    }
    return facts;
}

} // namespace plumb
