// SPDX-License-Identifier: MIT
#pragma once

// Which of many boxes overlap.

#include "plumb/math/math.h"

#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

// A binary tree over the boxes in Morton order. Every pair that overlaps belongs to one of the parts, which can be
// worked on at the same time.
class BoxPairs {
public:
    // boxes: at most 2^32 of them, finite.
    explicit BoxPairs(std::span<const Box3f> boxes);

    std::size_t part_count() const { return (order_.size() + part_size - 1) / part_size; }

    // Calls search(i) for the boxes of a part, always in the same order. What it returns says with reaches(box) whether
    // what is in box i reaches another box that overlaps box i, and takes each such box j with meet(j). False if it
    // stopped early, since there were too many close together.
    template <class Search>
    bool for_each(std::size_t part, const Search& search) const
    {
        std::int64_t budget = budget_of_part();
        const std::size_t begin = part * part_size, end = std::min(begin + part_size, order_.size());
        for (std::size_t i = begin; i < end; ++i)
            if (!visit(i, budget, search(order_[i]))) return false;
        return true;
    }

private:
    static constexpr std::size_t part_size = 1024;
    static constexpr std::size_t leaf_size = 4;

    struct Node {
        std::size_t index;      // in nodes_; its children have 2 index and 2 index + 1
        std::size_t first_leaf; // below it
        std::size_t leaf_count;
    };

    static bool overlap(const Box3f& a, const Box3f& b)
    {
        return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
               a.min.z <= b.max.z && b.min.z <= a.max.z;
    }

    std::int64_t budget_of_part() const;

    // The pairs of box i, of the sorted ones, with later ones.
    template <class Searcher>
    bool visit(std::size_t i, std::int64_t& budget, Searcher searcher) const
    {
        constexpr std::int64_t cost_of_meeting = 50; // in tests of boxes
        const Box3f& own = sorted_[i];
        Node stack[64];
        std::size_t height = 0;
        stack[height++] = {1, 0, leaf_count_};
        while (height > 0) {
            const Node node = stack[--height];
            if (--budget < 0) return false;
            if ((node.first_leaf + node.leaf_count) * leaf_size <= i + 1) continue; // all are earlier ones
            const Box3f& box = nodes_[node.index];
            if (!overlap(own, box) || !searcher.reaches(box)) continue;
            if (node.leaf_count > 1) {
                const std::size_t half = node.leaf_count / 2;
                stack[height++] = {2 * node.index + 1, node.first_leaf + half, half};
                stack[height++] = {2 * node.index, node.first_leaf, half};
                continue;
            }
            const std::size_t end = std::min((node.first_leaf + 1) * leaf_size, sorted_.size());
            for (std::size_t j = std::max(node.first_leaf * leaf_size, i + 1); j < end; ++j) {
                if (!overlap(own, sorted_[j]) || !searcher.reaches(sorted_[j])) continue;
                budget -= cost_of_meeting;
                searcher.meet(order_[j]);
            }
        }
        return true;
    }

    std::vector<std::uint32_t> order_; // of the boxes
    std::vector<Box3f> sorted_;
    std::vector<Box3f> nodes_;
    std::size_t leaf_count_ = 1; // a power of two; the last ones are empty
};

} // namespace plumb
