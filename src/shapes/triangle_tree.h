// SPDX-License-Identifier: MIT
#pragma once

// Choosing one of the triangles of a mesh that emits, with a probability near the share of the receiver's light that comes
// from it: the part of the light tree (scene/light_tree.h) below a mesh.
//
// Up to eight neighbours make a cluster, whose bounds are computed from the mesh when a receiver is near; those of a small
// mesh are kept. Clusters are the
// leaves of a tree in which each node has up to eight children. Everything is in one order, in which clusters, and what is
// below a node, lie side by side. The tree ends early where all that is below a child looks alike to the receiver: from
// there on triangles are chosen by area. So a fine mesh costs a receiver no more than it can tell apart.
//
// Built in double precision, the same tree everywhere. 15 bytes a triangle and 12 for the choice by area; of a mesh with no
// more than 16,384 triangles 40 more.

#include "plumb/model/light_lanes.h"
#include "plumb/sampling/distribution.h"
#include "plumb/shapes/mesh.h"

#include <array>
#include <optional>
#include <vector>

namespace plumb {

class TriangleTree {
public:
    struct Choice {
        std::uint32_t triangle;
        double probability;
    };

    explicit TriangleTree(const MeshData& mesh); // which must outlive it

    // u in [0, 1) has 53 bits. Nothing where the triangles that u leads to cannot light the receiver: the probabilities of all
    // triangles add up to 1 or less.
    std::optional<Choice> choose(const LightReceiver& receiver, double u) const;
    // That of choosing a triangle: the same bits as in what choose() returns.
    double probability(const LightReceiver& receiver, std::uint32_t triangle) const;

    std::uint32_t choose_by_area(double u) const { return order_[by_area_.sample(u).index]; }

    std::uint64_t memory_bytes() const;

private:
    static constexpr std::uint32_t width = LightLanes::width;

    struct alignas(32) Node {
        LightLanes lights;
        std::array<std::uint32_t, width> child{}; // nodes; nothing where the child is a cluster
    };

    // Clusters side by side, those of a node or one alone.
    struct Clusters {
        std::uint32_t first = 0;
        std::uint32_t count = 1;

        std::uint32_t parts() const; // children of the node
        Clusters part(std::uint32_t k) const;
        std::uint32_t part_of(std::uint32_t cluster) const; // that part(k) holds
    };

    class Builder;

    LaneReceiver to_lanes(const LightReceiver& receiver) const;
    LightLanes triangles_of(std::uint32_t cluster) const;
    LightLanes::Sums importance_in(std::uint32_t cluster, const LaneReceiver& at) const;
    // Clusters have equally many places, but for one.
    std::uint32_t first_place(std::uint32_t cluster) const
    {
        return static_cast<std::uint32_t>(std::uint64_t{cluster} * order_.size() / clusters_);
    }
    std::uint32_t cluster_at(std::uint32_t place) const
    {
        return static_cast<std::uint32_t>(((place + std::uint64_t{1}) * clusters_ - 1) / order_.size());
    }

    const MeshData& mesh_;
    std::vector<std::uint32_t> order_; // the triangle at each place
    std::vector<std::uint32_t> place_; // of each triangle
    std::uint32_t clusters_ = 0;
    std::vector<Node> nodes_; // the root is the first; none where there is but one cluster
    static constexpr std::uint32_t most_kept = 2048; // clusters
    std::vector<LightLanes> kept_;                   // triangles_of() each cluster, where there are no more
    DiscreteDistribution by_area_;                   // of places
    LightLanes::Space space_;
    double area_ = 0.0;
};

} // namespace plumb
