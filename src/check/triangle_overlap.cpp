// SPDX-License-Identifier: MIT
#include "check/triangle_overlap.h"

namespace plumb {

namespace {

constexpr double roundings_d = 16.0 * static_cast<double>(unit_roundoff);

// What rounding does to a plane's offset: the coordinates' errors along its normal.
double plane_error(const FlatTriangle& triangle, const Vec3d& normal)
{
    double error = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double largest = 0.0;
        for (const Vec3d& corner : triangle.corners) largest = std::max(largest, std::abs(corner[axis]));
        error += largest * std::abs(normal[axis]);
    }
    return roundings_d * error;
}

struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
};

Interval extent_along(const Vec3d& direction, const FlatTriangle& triangle, const Vec3d& origin)
{
    Interval extent;
    for (const Vec3d& corner : triangle.corners) {
        const double x = dot(direction, corner - origin);
        extent.low = std::min(extent.low, x);
        extent.high = std::max(extent.high, x);
    }
    return extent;
}

// Triangles of one plane overlap unless one of their edges has them on different sides; `strip` does not count.
bool is_separated_by_edge_of(const FlatTriangle& a, const FlatTriangle& b, double strip)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d& origin = a.corners[i];
        const Vec3d across = cross(a.normal, a.corners[(i + 1) % 3] - origin);
        const double length_of_edge = length(across);
        if (!(length_of_edge > 0.0)) continue;
        const Vec3d direction = across / length_of_edge;
        const Interval of_a = extent_along(direction, a, origin), of_b = extent_along(direction, b, origin);
        if (std::min(of_a.high, of_b.high) - std::max(of_a.low, of_b.low) <= strip) return true;
    }
    return false;
}

} // namespace

FlatTriangle::FlatTriangle(const TriangleCorners& t)
    : corners{Vec3d(t.p0), Vec3d(t.p1), Vec3d(t.p2)}, normal(0.0), area(0.0), magnitude(0.0), size(0.0)
{
    const Vec3d twice = triangle_cross(t.edges());
    area = 0.5 * length(twice);
    if (area > 0.0) normal = twice / (2.0 * area);
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
        magnitude = std::max({magnitude, std::abs(low), std::abs(high)});
        size = std::max(size, high - low);
    }
}

std::optional<double> overlap_tolerance(const FlatTriangle& a, const FlatTriangle& b)
{
    constexpr double nearly_parallel = 0.99;
    if (!(a.area > 0.0 && b.area > 0.0) || std::abs(dot(a.normal, b.normal)) < nearly_parallel) return {};
    const FlatTriangle& large = a.area < b.area ? b : a;
    const FlatTriangle& small = a.area < b.area ? a : b;
    constexpr double of_size = 1e-6;
    const double tolerance =
        std::max(of_size * small.size, plane_error(large, large.normal) + plane_error(small, large.normal));
    for (const Vec3d& corner : small.corners)
        if (std::abs(dot(large.normal, corner - large.corners[0])) > tolerance) return {};
    constexpr double narrow = 1e-3; // of the smaller triangle's width
    const double strip = std::max(roundings_d * (a.magnitude + b.magnitude), narrow * std::sqrt(small.area));
    if (is_separated_by_edge_of(a, b, strip) || is_separated_by_edge_of(b, a, strip)) return {};
    return tolerance;
}

} // namespace plumb
