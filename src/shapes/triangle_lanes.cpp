// SPDX-License-Identifier: MIT

#include "shapes/triangle_lanes.h"

#include "shapes/triangle.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr std::size_t width = LightLanes::width;

template <class T>
struct Vectors {
    std::array<T, width> x{}, y{}, z{};

    void set(std::size_t lane, const Vec3f& v)
    {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
};

// The vertex normals decide which side is the front.
Vec3f sum_of_normals(const MeshData& mesh, const MeshData::Triangle& t)
{
    return mesh.normals.empty() ? Vec3f(0.f) : mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
}

} // namespace

Facet facet_of(const MeshData& mesh, std::uint32_t triangle)
{
    const MeshData::Triangle& t = mesh.triangles[triangle];
    Facet facet{{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}, Vec3f(0.f)};
    const auto& [a, b, c] = facet.corners;
    const Vec3d normal = triangle_cross(TriangleEdges(a, b, c));
    const double size = length(normal);
    if (!(size > 0.0)) return facet;
    facet.area = size * 0.5;
    facet.normal = Vec3f(normal * (1.0 / size));
    if (dot(sum_of_normals(mesh, t), facet.normal) < 0.f) facet.normal = -facet.normal;
    return facet;
}

LightLanes lanes_of(const MeshData& mesh, std::span<const std::uint32_t> triangles,
                    const LightLanes::Space& space, double unit)
{
    Vectors<double> a, b, c;
    Vectors<float> front;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const MeshData::Triangle& t = mesh.triangles[triangles[k]];
        a.set(k, mesh.positions[t[0]]);
        b.set(k, mesh.positions[t[1]]);
        c.set(k, mesh.positions[t[2]]);
        front.set(k, sum_of_normals(mesh, t));
    }
    LightLanes lanes;
    const double to_intensity = 0.5 / unit;
    for (std::size_t k = 0; k < width; ++k) {
        const double ux = b.x[k] - a.x[k], uy = b.y[k] - a.y[k], uz = b.z[k] - a.z[k];
        const double vx = c.x[k] - a.x[k], vy = c.y[k] - a.y[k], vz = c.z[k] - a.z[k];
        const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const double size = std::sqrt(nx * nx + ny * ny + nz * nz);
        const double inverse = size > 0.0 ? 1.0 / size : 0.0;
        const auto x = static_cast<float>(nx * inverse);
        const auto y = static_cast<float>(ny * inverse);
        const auto z = static_cast<float>(nz * inverse);
        const float side = front.x[k] * x + front.y[k] * y + front.z[k] * z < 0.f ? -1.f : 1.f;
        lanes.axis_x[k] = x * side;
        lanes.axis_y[k] = y * side;
        lanes.axis_z[k] = z * side;
        lanes.cosine[k] = 1.f;
        lanes.intensity[k] = static_cast<float>(size * to_intensity);
    }
    const auto set_sphere = [&](const std::array<double, width>& p, const std::array<double, width>& q,
                                const std::array<double, width>& r, double origin, LightLanes::Lanes& center,
                                std::array<double, width>& radius2) {
        for (std::size_t k = 0; k < width; ++k) {
            const double low = (std::min(std::min(p[k], q[k]), r[k]) - origin) * space.scale;
            const double high = (std::max(std::max(p[k], q[k]), r[k]) - origin) * space.scale;
            center[k] = static_cast<float>((low + high) * 0.5);
            const double middle = static_cast<double>(center[k]);
            const double reach = std::max(middle - low, high - middle);
            radius2[k] += reach * reach;
        }
    };
    std::array<double, width> radius2{};
    set_sphere(a.x, b.x, c.x, space.origin.x, lanes.x, radius2);
    set_sphere(a.y, b.y, c.y, space.origin.y, lanes.y, radius2);
    set_sphere(a.z, b.z, c.z, space.origin.z, lanes.z, radius2);
    for (std::size_t k = 0; k < width; ++k)
        lanes.radius[k] = static_cast<float>(std::sqrt(radius2[k]) * (1.0 + 2.0 * unit_roundoff));
    return lanes;
}

} // namespace plumb
