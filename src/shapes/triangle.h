// SPDX-License-Identifier: MIT
#pragma once

// What triangle meshes and rectangles share: points of a triangle, and how far they may be from what Embree traces.

#include "plumb/intersection.h"
#include "plumb/math.h"

namespace plumb {

struct TriangleCorners {
    const Vec3f& p0;
    const Vec3f& p1;
    const Vec3f& p2;
    TriangleEdges edges() const { return {p0, p1, p2}; }
};

// Not normalised: its length is twice the area. Zero for triangles without area.
inline Vec3d triangle_cross(const TriangleEdges& t)
{
    return cross(t.edge1, t.edge2);
}

inline Vec3f triangle_point(const TriangleEdges& t, const Barycentric& b)
{
    const Vec3d p = t.corner + t.edge1 * b.u + t.edge2 * b.v;
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// SurfacePoint::clearance of any point of the triangle. normal: of unit length; normal_length: twice the area.
//
// Embree subtracts the ray's origin from the corners and takes the normal from products of their differences, all
// in single precision. On each axis that errs by a few roundings of the coordinates; and in slivers the normal
// itself errs, by an angle that moves the plane by the product of the three extents divided by twice the area.
// Both vanish in a plane perpendicular to an axis, as they should. The factors were found by experiment: see
// tests/statistical/self_intersection_test.cpp.
inline float triangle_clearance(const TriangleCorners& t, const Vec3f& normal, double normal_length)
{
    constexpr float coordinate_factor = 4.f * unit_roundoff;
    constexpr double sliver_factor = 4.0 * unit_roundoff;
    const auto largest = [](float a, float b, float c) {
        return std::max({std::abs(a), std::abs(b), std::abs(c)});
    };
    const auto extent = [](float a, float b, float c) {
        return static_cast<double>(std::max({a, b, c}) - std::min({a, b, c}));
    };
    const double volume =
        extent(t.p0.x, t.p1.x, t.p2.x) * extent(t.p0.y, t.p1.y, t.p2.y) * extent(t.p0.z, t.p1.z, t.p2.z);
    const auto tilt = normal_length > 0.0 ? static_cast<float>(sliver_factor * volume / normal_length) : 0.f;
    const Vec3f corner(largest(t.p0.x, t.p1.x, t.p2.x), largest(t.p0.y, t.p1.y, t.p2.y),
                       largest(t.p0.z, t.p1.z, t.p2.z));
    return clearance(corner * coordinate_factor + Vec3f(tilt), corner, normal);
}

// How far points of a triangle stay from its edges, so that single precision holds them on this side of a surface that
// meets the triangle there: a ray that starts on the floor, where the wall stands on it, must not start behind the wall.
// The error of a ray-triangle test at the wall and the rounding of the point are 4 and 1 roundings of the coordinates, and
// walls need not be upright: tests/statistical/closed_room_test.cpp.
struct EdgeClearance {
    EdgeClearance() = default;
    // normal_length: twice the area.
    EdgeClearance(const TriangleCorners& t, double normal_length)
    {
        constexpr double factor = 8.0 * unit_roundoff;
        double largest = 0.0, extents = 0.0;
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax({t.p0[i], t.p1[i], t.p2[i]});
            largest = std::max({largest, static_cast<double>(-low), static_cast<double>(high)});
            extents += static_cast<double>(high) - static_cast<double>(low);
        }
        distance = factor * largest;
        // No edge is longer than the sum of the extents, and a height is twice the area by the edge.
        margin = 2.0 * distance * extents / normal_length;
    }

    double distance = 0.0; // from an edge
    double margin = 0.0;   // points with larger barycentric coordinates are further away than twice that
};

// The point with these barycentric coordinates, moved away from edges that are too close: from one edge to at least the
// clearance, between two to the middle. Never further than the clearance for each edge, so that slivers keep their shape.
inline Vec3f point_off_edges(const TriangleEdges& t, const Barycentric& b, const EdgeClearance& clearance)
{
    const double w = 1.0 - b.u - b.v;
    if (std::min({b.u, b.v, w}) >= clearance.margin) [[likely]]
        return triangle_point(t, b);

    const Vec3d normal = triangle_cross(t);
    const double normal_length = length(normal);
    Vec3d p = t.corner + t.edge1 * b.u + t.edge2 * b.v;
    const auto leave = [&](const Vec3d& edge, double coordinate) {
        const double edge_length = length(edge);
        const double distance = coordinate * normal_length / edge_length;
        const double move = clearance.distance - 0.5 * distance;
        if (move > 0.0) p += cross(normal, edge) * (move / (normal_length * edge_length));
    };
    if (!(normal_length > 0.0)) return triangle_point(t, b);
    leave(t.edge1, b.v);
    leave(t.edge2 - t.edge1, w);
    leave(-t.edge2, b.u);
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

} // namespace plumb
