// SPDX-License-Identifier: MIT

#include "integrators/cell_tree.h"

#include <algorithm>
#include <numeric>

namespace plumb {

CellTree::CellTree(std::span<const Vec3f> points, std::size_t most, Members& members)
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
    Box3f box;
    for (const Vec3f& point : points) box.extendBy(point);
    find_starts(box);
}

void CellTree::find_starts(const Box3f& box)
{
    starts_.assign(std::size_t{starts} * starts * starts, 0);
    if (box.isEmpty()) return;
    corner_ = box.min;
    // Rounding finds positions in a cell that are this much outside.
    constexpr double slack = 1e-3;
    Vec3d size(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = (static_cast<double>(box.max[axis]) - static_cast<double>(box.min[axis])) / starts;
        cells_per_unit_[axis] = size[axis] > 0.0 ? static_cast<float>(std::min(1.0 / size[axis], 1e30)) : 0.f;
    }
    for (std::size_t i = 0; i < starts_.size(); ++i) {
        const std::size_t place[3] = {i % starts, i / starts % starts, i / starts / starts};
        std::uint32_t node = 0;
        while (nodes_[node].axis != leaf) {
            const auto axis = static_cast<int>(nodes_[node].axis);
            const auto k = static_cast<double>(place[axis]);
            const double from_corner =
                static_cast<double>(nodes_[node].split) - static_cast<double>(corner_[axis]);
            // Cells at the border have all beyond it.
            if (place[axis] + 1 < starts && (k + 1.0 + slack) * size[axis] < from_corner)
                node = nodes_[node].child;
            else if (place[axis] > 0 && (k - slack) * size[axis] > from_corner)
                node = nodes_[node].child + 1;
            else
                break;
        }
        starts_[i] = node;
    }
}

} // namespace plumb
