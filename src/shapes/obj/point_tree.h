// SPDX-License-Identifier: MIT
#pragma once

// Points of a plane in boxes inside boxes, to find those in a triangle. They can be removed.

#include "shapes/obj/plane_point.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace plumb {

using PlaneTriangle = std::array<PlanePoint, 3>; // counter-clockwise

class PointTree {
public:
    // members: numbers of points, which must stay.
    PointTree(std::span<const PlanePoint> points, std::vector<std::uint32_t> members);

    void remove(std::uint32_t point); // does nothing where it is not a member

    // Calls visit for members until it says true, and returns whether it did. None is left out that lies in the
    // triangle, on its border, or at most `margin` outside an edge; some others may be visited.
    template <class Visit>
    bool any_in(const PlaneTriangle& triangle, double margin, const Visit& visit)
    {
        return !nodes_.empty() && any_in(0, Query(triangle, margin), visit);
    }

    // How many boxes and points were looked at so far: a measure of time that is the same on every run.
    std::uint64_t steps() const { return steps_; }

private:
    struct Box {
        double min_x = std::numeric_limits<double>::infinity();
        double max_x = -std::numeric_limits<double>::infinity();
        double min_y = std::numeric_limits<double>::infinity();
        double max_y = -std::numeric_limits<double>::infinity();

        void extend(const PlanePoint& p);
    };
    struct Node {
        Box box;
        std::uint32_t begin = 0; // of members_
        std::uint32_t end = 0;
        std::uint32_t alive = 0;
        std::uint32_t parent = none;
        std::uint32_t right = none; // the left one follows; none: a leaf
    };
    struct Query {
        Query(const PlaneTriangle& triangle, double margin);
        bool misses(const Box& box) const;

        PlaneTriangle corners;
        Box around;
        double margins[3]; // of `turn` about the three edges
    };
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    void build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent);

    // Recursion ends: a child has half of its parent's members.
    template <class Visit>
    bool any_in(std::uint32_t number, const Query& query, const Visit& visit)
    {
        const Node& node = nodes_[number];
        ++steps_;
        if (node.alive == 0 || query.misses(node.box)) return false;
        if (node.right != none) return any_in(number + 1, query, visit) || any_in(node.right, query, visit);
        steps_ += node.end - node.begin;
        for (std::uint32_t i = node.begin; i < node.end; ++i)
            if (leaf_of_[members_[i]] != none && visit(members_[i])) return true;
        return false;
    }

    std::span<const PlanePoint> points_;
    std::vector<std::uint32_t> members_;
    std::vector<std::uint32_t> leaf_of_; // for each point; none: no member, or removed
    std::vector<Node> nodes_;
    std::uint64_t steps_ = 0;
};

} // namespace plumb
