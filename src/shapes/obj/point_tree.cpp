// SPDX-License-Identifier: MIT

#include "shapes/obj/point_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb {

void PointTree::Box::extend(const PlanePoint& p)
{
    min_x = std::min(min_x, p.x);
    max_x = std::max(max_x, p.x);
    min_y = std::min(min_y, p.y);
    max_y = std::max(max_y, p.y);
}

PointTree::PointTree(std::span<const PlanePoint> points, std::vector<std::uint32_t> members)
    : points_(points), members_(std::move(members)), leaf_of_(points.size(), none)
{
    if (!members_.empty()) build(0, static_cast<std::uint32_t>(members_.size()), none);
}

// Halves the members across the longer side of their box.
void PointTree::build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent)
{
    constexpr std::uint32_t leaf_size = 8;
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    Node node{.box = {}, .begin = begin, .end = end, .alive = end - begin, .parent = parent};
    for (std::uint32_t i = begin; i < end; ++i) node.box.extend(points_[members_[i]]);
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {
        for (std::uint32_t i = begin; i < end; ++i) leaf_of_[members_[i]] = number;
        return;
    }
    const bool in_x = node.box.max_x - node.box.min_x >= node.box.max_y - node.box.min_y;
    const std::uint32_t middle = begin + (end - begin) / 2;
    // With the numbers, so that the halves are the same with every standard library.
    const auto place = [&](std::uint32_t i) { return std::pair(in_x ? points_[i].x : points_[i].y, i); };
    std::nth_element(members_.begin() + begin, members_.begin() + middle, members_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    build(begin, middle, number);
    nodes_[number].right = static_cast<std::uint32_t>(nodes_.size());
    build(middle, end, number);
}

void PointTree::remove(std::uint32_t point)
{
    const std::uint32_t leaf = std::exchange(leaf_of_[point], none);
    for (std::uint32_t number = leaf; number != none; number = nodes_[number].parent) --nodes_[number].alive;
}

PointTree::Query::Query(const PlaneTriangle& triangle, double margin) : corners(triangle)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const PlanePoint& a = triangle[i];
        const PlanePoint& b = triangle[(i + 1) % 3];
        margins[i] = margin * std::hypot(b.x - a.x, b.y - a.y);
        around.extend({a.x - margin, a.y - margin});
        around.extend({a.x + margin, a.y + margin});
    }
}

// Whether all of the box lies outside one of the edges, and surely so.
bool PointTree::Query::misses(const Box& box) const
{
    if (box.min_x > around.max_x || box.max_x < around.min_x || box.min_y > around.max_y ||
        box.max_y < around.min_y)
        return true;
    constexpr double rounding = 1e-15;
    for (std::size_t i = 0; i < 3; ++i) {
        const PlanePoint& a = corners[i];
        const PlanePoint& b = corners[(i + 1) % 3];
        // `turn` of the corner of the box that is furthest inside
        const double up = (b.x - a.x) * ((b.x > a.x ? box.max_y : box.min_y) - a.y);
        const double across = (b.y - a.y) * ((b.y > a.y ? box.min_x : box.max_x) - a.x);
        if (up - across < -margins[i] - rounding * (std::abs(up) + std::abs(across))) return true;
    }
    return false;
}

} // namespace plumb
