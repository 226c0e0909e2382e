// SPDX-License-Identifier: MIT
#pragma once

// What triangle meshes and rectangles share: points of a triangle, and how far they may be from what Embree traces.

#include "plumb/math/math.h"
#include "shapes/intersection.h"

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

// How far points of a surface stay from its edges, so that single precision holds them on this side of another surface that
// meets it there: a ray that starts on the floor, where the wall stands on it, must not start behind the wall. largest:
// the largest |coordinate|. The error of a ray-triangle test at the wall and the rounding of the point are 4 and 1
// roundings of the coordinates, and walls need not be upright: tests/statistical/closed_room_test.cpp.
inline double edge_clearance(float largest)
{
    return static_cast<double>(largest) * (8.0 * unit_roundoff);
}

inline float largest_coordinate(const Box3f& box)
{
    return std::max(max_component(abs(box.min)), max_component(abs(box.max)));
}

// Points of the triangle whose barycentric coordinates are all larger than this are further from its edges than twice the
// clearance: no edge is longer than the sum of the extents, and a height is twice the area by the edge.
double edge_margin(const TriangleEdges& t, double clearance);

// The point with these barycentric coordinates, moved away from edges that are too close: from one edge to at least the
// clearance, between two to the middle. Never further than the clearance for each edge, so that slivers keep their shape.
Vec3f point_off_edges(const TriangleEdges& t, const Barycentric& b, double clearance);

} // namespace plumb
