// SPDX-License-Identifier: MIT
#pragma once

// Space cut into cells that have about as many of some points each: a k-d tree.

#include "plumb/math/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

class CellTree {
public:
    // What is left of the building: the points of each node.
    struct Members {
        std::vector<std::uint32_t> order; // numbers of points; those of a leaf ascend
        struct Range {
            std::size_t first = 0;
            std::size_t last = 0;
        };
        std::vector<Range> of_nodes; // in order

        std::span<const std::uint32_t> of(std::size_t node) const
        {
            return std::span(order).subspan(of_nodes[node].first, of_nodes[node].last - of_nodes[node].first);
        }
    };

    CellTree() = default;
    // A leaf has `most` points at most. A pure function of the points in their order.
    CellTree(std::span<const Vec3f> points, std::size_t most, Members& members);

    // The root is node 0, and children have larger numbers than their parents.
    std::size_t nodes() const { return nodes_.size(); }
    bool is_leaf(std::size_t node) const { return nodes_[node].axis == leaf; }
    std::size_t first_child(std::size_t node) const { return nodes_[node].child; } // the other is the next

    // Whether the first child has the position, or the other.
    bool is_first_of(std::size_t node, const Vec3f& position) const
    {
        return position[static_cast<int>(nodes_[node].axis)] < nodes_[node].split;
    }
    // The leaf of any position. Needs a tree.
    std::size_t leaf_at(const Vec3f& position) const
    {
        std::size_t node = starts_[start_of(position)];
        while (!is_leaf(node)) node = first_child(node) + (is_first_of(node, position) ? 0 : 1);
        return node;
    }

private:
    static constexpr std::uint32_t leaf = 3;
    struct Node {
        float split = 0.f;
        std::uint32_t axis = leaf;
        std::uint32_t child = 0; // the first of two
    };
    std::vector<Node> nodes_;

    // Space is cut into equal cells too, each with the last node that has all of it: so the way down is short.
    static constexpr int starts = 16; // along each axis
    std::size_t start_of(const Vec3f& position) const
    {
        const auto along = [](float x) {
            return static_cast<std::size_t>(std::min(std::max(0.f, x), static_cast<float>(starts - 1)));
        };
        const Vec3f cell = (position - corner_) * cells_per_unit_;
        return (along(cell.z) * starts + along(cell.y)) * starts + along(cell.x);
    }
    void find_starts(const Box3f& box);
    Vec3f corner_{0.f};
    Vec3f cells_per_unit_{0.f};
    std::vector<std::uint32_t> starts_;
};

} // namespace plumb
