// SPDX-License-Identifier: MIT

#include "integrators/point_tree.h"

#include <algorithm>
#include <numeric>

namespace plumb {

PointTree::PointTree(std::span<const Vec3f> points, std::size_t most, Members& members)
{
    members.order.resize(points.size());
    std::iota(members.order.begin(), members.order.end(), 0u);
    members.of_nodes = {{0, points.size()}};
    nodes_.emplace_back();
    for (std::size_t node = 0; node < nodes_.size(); ++node) { // which grow
        const Members::Range range = members.of_nodes[node];
        const std::span<std::uint32_t> mine =
            std::span(members.order).subspan(range.first, range.last - range.first);
        if (mine.size() <= most) {
            std::sort(mine.begin(), mine.end());
            continue;
        }
        Box3f box;
        for (const std::uint32_t i : mine) box.extendBy(points[i]);
        const auto axis = static_cast<int>(box.majorAxis());
        const auto before = [&](std::uint32_t a, std::uint32_t b) {
            return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
        };
        const std::size_t half = mine.size() / 2;
        std::nth_element(mine.begin(), mine.begin() + static_cast<std::ptrdiff_t>(half), mine.end(), before);
        nodes_[node] = {points[mine[half]][axis], static_cast<std::uint32_t>(axis),
                        static_cast<std::uint32_t>(nodes_.size())};
        members.of_nodes.push_back({range.first, range.first + half});
        members.of_nodes.push_back({range.first + half, range.last});
        nodes_.resize(nodes_.size() + 2);
    }
}

} // namespace plumb
