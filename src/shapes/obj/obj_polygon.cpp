// SPDX-License-Identifier: MIT

// Concave polygons with few corners are cut by removing the next best ear, whose existence is Meisters' theorem [1]; the
// time goes with the cube of their corners. Larger ones, and those that touch themselves in a way that it does not
// understand, go to polygon_ears.cpp, which makes other triangles.
//
// [1] Meisters 1975, "Polygons Have Ears", The American Mathematical Monthly 82(6).

#include "shapes/obj/obj_polygon.h"

#include <optional>

namespace plumb {

namespace {

// Up to here, images have their bits from these triangles. It takes 0.1 ms.
constexpr std::size_t max_simple_corners = 128;

// The polygon seen from the side that its normal points to: counter-clockwise, along the normal's longest axis.
std::vector<PlanePoint> flatten(std::span<const Vec3f> polygon, const Vec3d& normal)
{
    const Vec3d size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    const bool flip = normal[axis] < 0.0;
    std::vector<PlanePoint> points;
    points.reserve(polygon.size());
    for (const Vec3f& p : polygon)
        points.push_back(flip ? PlanePoint{p[second], p[first]} : PlanePoint{p[first], p[second]});
    return points;
}

// No corner turns clockwise, and the boundary goes round once: from the first corner, every corner lies further
// counter-clockwise than the one before it.
bool is_convex(const std::vector<PlanePoint>& points)
{
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(points[i], points[(i + 1) % n], points[(i + 2) % n]) < 0.0) return false;
        if (i + 2 < n && turn(points[0], points[i + 1], points[i + 2]) < 0.0) return false;
    }
    return true;
}

class EarClipper {
public:
    explicit EarClipper(const std::vector<PlanePoint>& points) : points_(points), left_(points.size())
    {
        for (std::uint32_t i = 0; i < left_.size(); ++i) left_[i] = i;
    }

    void run(std::vector<PolygonTriangle>& triangles)
    {
        std::size_t start = 0;
        while (left_.size() > 3) {
            const std::optional<std::size_t> ear = find_ear(start);
            if (!ear) break; // the boundary crosses itself, or what is left has no area
            triangles.push_back({before(*ear), left_[*ear], after(*ear)});
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(*ear));
            start = *ear; // goes on with the next corner: all round the polygon rather than a fan of slivers
        }
        for (std::size_t i = 1; i + 1 < left_.size(); ++i)
            triangles.push_back({left_[0], left_[i], left_[i + 1]});
    }

private:
    std::uint32_t before(std::size_t i) const { return left_[(i + left_.size() - 1) % left_.size()]; }
    std::uint32_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }

    std::optional<std::size_t> find_ear(std::size_t start) const
    {
        for (std::size_t k = 0; k < left_.size(); ++k)
            if (is_ear((start + k) % left_.size())) return (start + k) % left_.size();
        return std::nullopt;
    }

    bool is_ear(std::size_t i) const
    {
        const PlanePoint& a = points_[before(i)];
        const PlanePoint& b = points_[left_[i]];
        const PlanePoint& c = points_[after(i)];
        if (turn(a, b, c) <= 0.0) return false;
        for (const std::uint32_t other : left_) {
            const PlanePoint& p = points_[other];
            if (p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
        }
        return true;
    }

    const std::vector<PlanePoint>& points_;
    std::vector<std::uint32_t> left_; // the corners of what is left of the polygon
};

std::vector<PolygonTriangle> cut_concave(const std::vector<PlanePoint>& points)
{
    std::vector<PolygonTriangle> cut;
    if (points.size() <= max_simple_corners) {
        EarClipper(points).run(cut);
        constexpr double rounding = 1e-6;
        double area = 0.0;
        for (const PolygonTriangle& t : cut) area += 0.5 * turn(points[t[0]], points[t[1]], points[t[2]]);
        if (folded_area(points, cut) <= rounding * area) return cut;
    }
    std::vector<PolygonTriangle> better = cut_polygon(points).triangles;
    return cut.empty() || folded_area(points, better) < folded_area(points, cut) ? better : cut;
}

Vec3d corner_normal(std::span<const Vec3f> polygon, int a, int b, int c)
{
    const Vec3d origin(polygon[static_cast<std::size_t>(a)]);
    return cross(Vec3d(polygon[static_cast<std::size_t>(b)]) - origin,
                 Vec3d(polygon[static_cast<std::size_t>(c)]) - origin);
}

// A quad that is concave at its second or fourth corner: a b c and a c d overlap, b c d and b d a do not.
bool needs_other_diagonal(std::span<const Vec3f> quad)
{
    return dot(corner_normal(quad, 0, 1, 2), corner_normal(quad, 0, 2, 3)) < 0.0 &&
           dot(corner_normal(quad, 1, 2, 3), corner_normal(quad, 1, 3, 0)) > 0.0;
}

} // namespace

Vec3d newell_normal(std::span<const Vec3f> polygon)
{
    const Vec3d origin(polygon[0]);
    Vec3d sum(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += cross(Vec3d(polygon[i]) - origin, Vec3d(polygon[i + 1]) - origin);
    return sum;
}

void triangulate_polygon(std::span<const Vec3f> polygon, std::vector<PolygonTriangle>& triangles)
{
    const auto count = static_cast<std::uint32_t>(polygon.size());
    if (count == 4 && needs_other_diagonal(polygon)) {
        triangles.push_back({1, 2, 3});
        triangles.push_back({1, 3, 0});
        return;
    }
    if (count > 4) {
        const std::vector<PlanePoint> points = flatten(polygon, newell_normal(polygon));
        if (!is_convex(points)) {
            const std::vector<PolygonTriangle> cut = cut_concave(points);
            triangles.insert(triangles.end(), cut.begin(), cut.end());
            return;
        }
    }
    for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
}

} // namespace plumb
