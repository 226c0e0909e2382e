// SPDX-License-Identifier: MIT
#include "check/box_pairs.h"

#include <algorithm>
#include <utility>

namespace plumb {

namespace {

// The lowest 21 bits, with two zeros between each.
std::uint64_t spread(std::uint64_t x)
{
    x &= 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

// Of the middle of a box, in the box around all.
std::uint64_t morton_code(const Box3f& box, const Box3f& all)
{
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double extent = static_cast<double>(all.max[axis]) - static_cast<double>(all.min[axis]);
        const double middle = 0.5 * (static_cast<double>(box.min[axis]) + static_cast<double>(box.max[axis]));
        const double place = extent > 0.0 ? (middle - static_cast<double>(all.min[axis])) / extent : 0.0;
        code |= spread(static_cast<std::uint64_t>(std::clamp(place, 0.0, 1.0) * 0x1fffff)) << axis;
    }
    return code;
}

} // namespace

BoxPairs::BoxPairs(std::span<const Box3f> boxes)
{
    Box3f all;
    for (const Box3f& box : boxes) all.extendBy(box);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> codes(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) codes[i] = {morton_code(boxes[i], all), i};
    std::sort(codes.begin(), codes.end());

    order_.reserve(boxes.size());
    sorted_.reserve(boxes.size());
    for (const auto& [code, i] : codes) {
        order_.push_back(i);
        sorted_.push_back(boxes[i]);
    }
    while (leaf_count_ * leaf_size < boxes.size()) leaf_count_ *= 2;
    nodes_.resize(2 * leaf_count_); // empty
    for (std::size_t i = 0; i < sorted_.size(); ++i) nodes_[leaf_count_ + i / leaf_size].extendBy(sorted_[i]);
    for (std::size_t node = leaf_count_ - 1; node > 0; --node) {
        nodes_[node].extendBy(nodes_[2 * node]);
        nodes_[node].extendBy(nodes_[2 * node + 1]);
    }
}

// So that all parts together take seconds at most, and parts of few boxes have enough for any arrangement of them.
std::int64_t BoxPairs::budget_of_part() const
{
    constexpr std::int64_t of_all = 2'000'000'000, at_least = 2'000'000;
    return std::max(of_all / static_cast<std::int64_t>(std::max<std::size_t>(part_count(), 1)), at_least);
}

} // namespace plumb
