// SPDX-License-Identifier: MIT
#pragma once

// Choosing one of many emitters, with a probability near the share of the receiver's light that comes from it.
//
// [1] Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", PACMCGIT 1(2).
// [2] Pharr, Jakob and Humphreys 2023, Physically Based Rendering, 4th edition, section 12.6.3.
//
// Finite emitters are the leaves of a tree in which each node has up to eight children. A child is known by the sphere
// around its lights, the cone of the normals of their surfaces, and their power; these bound how much of its light may
// reach a receiver ([2], figure 12.24). On the way down a child is chosen in proportion to that. Infinite emitters
// stand beside the root, for what they are expected to send to any place of the scene; but glossy surfaces may show
// nothing else, so that they are chosen as often as their share of the power says, or half of the time, at least.
//
// The bounds assume that a receiver is diffuse. A glossy one may reflect the emitter that promises least and none of the
// others: there, some choices are uniform among the finite emitters, three of four where they are few. With many, uniform
// choice finds what is reflected too seldom to help, and its share falls as their number grows.
//
// Built serially, in double precision: the same tree everywhere.

#include "plumb/model/light_lanes.h"
#include "plumb/sampling/distribution.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace plumb {

class LightTree {
public:
    using Choice = DiscreteDistribution::Choice;

    enum class Among { all, delta };

    LightTree() = default;
    // The emitters must be prepared. Those of power 0 are never chosen.
    LightTree(std::span<const Emitter* const> emitters, Among among, const SceneSphere& sphere);

    bool can_sample() const { return only_ != none || !nodes_.empty() || infinite_.can_sample(); }

    // u in [0, 1) has 53 bits. Nothing where the emitters that u leads to cannot light the receiver: the
    // probabilities of all emitters add up to 1 or less. Needs can_sample().
    std::optional<Choice> choose(const LightReceiver& receiver, double u) const
    {
        if (only_ != none) [[likely]]
            return Choice{only_, 1.f, std::min(u, largest_below_one)};
        return receiver.is_glossy ? choose_at_glossy(receiver, u) : choose_among_several(receiver, u);
    }

    // That of choosing emitter `index` of those given: the same bits as in what choose() returns.
    float probability(const LightReceiver& receiver, std::size_t index) const
    {
        if (only_ != none) [[likely]]
            return index == only_ ? 1.f : 0.f;
        return receiver.is_glossy ? probability_at_glossy(receiver, index)
                                  : probability_among_several(receiver, index);
    }

private:
    static constexpr std::size_t width = LightLanes::width;
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    static constexpr double largest_below_one = 0x1.fffffffffffffp-1;

    // The children are lanes, in multiples of scale_ and of the largest power.
    struct alignas(64) Node {
        LightLanes lights;
        std::array<std::uint32_t, width> child{}; // a node, or an emitter with emitter_bit
    };
    static constexpr std::uint32_t emitter_bit = std::uint32_t{1} << 31;

    // Where an emitter is found: the number of its lane at the root in the lowest three bits, then that at the next
    // node, ...; or its number among the infinite ones.
    struct Place {
        enum class Kind { nowhere, tree, infinite } kind = Kind::nowhere;
        std::uint64_t path = 0;
    };
    static constexpr unsigned bits_per_level = 3;

    class Builder;
    struct Shares;

    std::optional<Choice> choose_at_glossy(const LightReceiver& receiver, double u) const;
    float probability_at_glossy(const LightReceiver& receiver, std::size_t index) const;
    std::optional<Choice> choose_among_several(const LightReceiver& receiver, double u) const;
    float probability_among_several(const LightReceiver& receiver, std::size_t index) const;
    Shares shares(std::uint32_t node, const LaneReceiver& receiver) const;

    std::uint32_t only_ = none; // the emitter, if there is one only
    std::vector<Node> nodes_;   // the root is the first
    std::vector<Place> places_; // of all emitters
    std::vector<std::uint32_t> infinite_emitters_;
    DiscreteDistribution infinite_;    // over infinite_emitters_
    double infinite_irradiance_ = 0.0; // expected, in the unit of importance
    double least_infinite_ = 0.0;  // importance of the infinite ones over that of the finite ones, at least
    float scale_ = 1.f;            // a power of two over the size of the scene
    DiscreteDistribution uniform_; // over all emitters: the finite ones alike
    double uniform_share_ = 0.0;   // of the choices at glossy receivers
};

} // namespace plumb
