// SPDX-License-Identifier: MIT

// Concave polygons are cut by removing ears, whose existence is Meisters' theorem:
// [1] Meisters 1975, "Polygons Have Ears", The American Mathematical Monthly 82(6).

#include "io/obj_polygon.h"

#include "plumb/error.h"

#include <fmt/format.h>

#include <optional>

namespace plumb {

namespace {

constexpr std::uint32_t max_concave_corners = 1u << 15; // the time goes with the square

struct Point {
    double x;
    double y;
};

// Twice the signed area of a b c: positive if they turn counter-clockwise.
double turn(const Point& a, const Point& b, const Point& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool same(const Point& a, const Point& b)
{
    return a.x == b.x && a.y == b.y;
}

// The polygon seen from the side that its normal points to: counter-clockwise, along the normal's longest axis.
std::vector<Point> flatten(std::span<const Vec3f> polygon, const Vec3d& normal)
{
    const Vec3d size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    const bool flip = normal[axis] < 0.0;
    std::vector<Point> points;
    points.reserve(polygon.size());
    for (const Vec3f& p : polygon)
        points.push_back(flip ? Point{p[second], p[first]} : Point{p[first], p[second]});
    return points;
}

// No corner turns clockwise, and the boundary goes round once: from the first corner, every corner lies further
// counter-clockwise than the one before it.
bool is_convex(const std::vector<Point>& points)
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
    explicit EarClipper(const std::vector<Point>& points) : points_(points), left_(points.size())
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
        const Point& a = points_[before(i)];
        const Point& b = points_[left_[i]];
        const Point& c = points_[after(i)];
        if (turn(a, b, c) <= 0.0) return false;
        for (const std::uint32_t other : left_) {
            const Point& p = points_[other];
            if (same(p, a) || same(p, b) || same(p, c)) continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
        }
        return true;
    }

    const std::vector<Point>& points_;
    std::vector<std::uint32_t> left_; // the corners of what is left of the polygon
};

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
        const std::vector<Point> points = flatten(polygon, newell_normal(polygon));
        if (!is_convex(points)) {
            if (count > max_concave_corners)
                throw Error(fmt::format(
                    "a face that is not convex has {} corners, and at most {} are supported; cut it "
                    "into triangles",
                    count, max_concave_corners));
            return EarClipper(points).run(triangles);
        }
    }
    for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.push_back({0, i, i + 1});
}

} // namespace plumb
