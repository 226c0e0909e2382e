// SPDX-License-Identifier: MIT

#include "plumb/scene/light_tree.h"

#include <algorithm>

namespace plumb {
namespace {

// The probability where some choices are uniform.
float mixed(double uniform_share, float uniform, float of_tree)
{
    if (!(uniform_share > 0.0)) return of_tree;
    return static_cast<float>(uniform_share * static_cast<double>(uniform) +
                              (1.0 - uniform_share) * static_cast<double>(of_tree));
}

} // namespace

// The running sums of the importance of what can be chosen at a node: its children and, at the root, the infinite
// emitters.
struct LightTree::Shares {
    static constexpr std::size_t infinite = width;
    std::array<double, width + 2> ends;

    double total() const { return ends[width + 1]; }
    double before(std::size_t k) const { return ends[k]; }
    double of(std::size_t k) const { return ends[k + 1] - ends[k]; }
};

LightTree::Shares LightTree::shares(std::uint32_t index, const LaneReceiver& receiver) const
{
    const LightLanes::Sums sums = nodes_[index].lights.importance(receiver);
    Shares shares;
    std::copy(sums.begin(), sums.end(), shares.ends.begin());
    const double finite = shares.ends[width];
    shares.ends[width + 1] =
        index == 0 ? finite + std::max(infinite_irradiance_, least_infinite_ * finite) : finite;
    return shares;
}

std::optional<LightTree::Choice> LightTree::choose_at_glossy(const LightReceiver& receiver, double u) const
{
    if (u < uniform_share_) {
        Choice choice = uniform_.sample(std::min(u / uniform_share_, largest_below_one));
        choice.probability = probability_at_glossy(receiver, choice.index);
        return choice;
    }
    std::optional<Choice> choice =
        choose_among_several(receiver, (u - uniform_share_) / (1.0 - uniform_share_));
    if (choice)
        choice->probability = mixed(uniform_share_, uniform_.probability(choice->index), choice->probability);
    return choice;
}

float LightTree::probability_at_glossy(const LightReceiver& receiver, std::size_t index) const
{
    return mixed(uniform_share_, uniform_.probability(index), probability_among_several(receiver, index));
}

std::optional<LightTree::Choice> LightTree::choose_among_several(const LightReceiver& at, double u) const
{
    const LaneReceiver receiver(at.position * scale_, at.normal);
    u = std::min(u, largest_below_one);
    if (nodes_.empty()) {
        const Choice choice = infinite_.sample(u);
        return Choice{infinite_emitters_[choice.index], choice.probability, choice.u};
    }
    double probability = 1.0;
    std::uint32_t node = 0;
    for (;;) {
        const Shares here = shares(node, receiver);
        if (!(here.total() > 0.0)) return std::nullopt;
        const double target = u * here.total(); // below the total, however it is rounded
        std::size_t child = 0;
        for (std::size_t k = 1; k <= Shares::infinite; ++k) child += here.before(k) <= target ? 1 : 0;
        u = std::min((target - here.before(child)) / here.of(child), largest_below_one);
        probability *= here.of(child) / here.total();
        if (child == Shares::infinite) {
            const Choice choice = infinite_.sample(u);
            return Choice{infinite_emitters_[choice.index],
                          static_cast<float>(probability * static_cast<double>(choice.probability)),
                          choice.u};
        }
        node = nodes_[node].child[child];
        if (node & emitter_bit) return Choice{node & ~emitter_bit, static_cast<float>(probability), u};
    }
}

float LightTree::probability_among_several(const LightReceiver& at, std::size_t index) const
{
    const Place& place = places_[index];
    if (place.kind == Place::Kind::nowhere) return 0.f;
    if (place.kind == Place::Kind::infinite && nodes_.empty()) return infinite_.probability(place.path);

    const LaneReceiver receiver(at.position * scale_, at.normal);
    double probability = 1.0;
    std::uint64_t path = place.path;
    std::uint32_t node = 0;
    for (;;) {
        const Shares here = shares(node, receiver);
        if (!(here.total() > 0.0)) return 0.f;
        if (place.kind == Place::Kind::infinite) {
            probability *= here.of(Shares::infinite) / here.total();
            return static_cast<float>(probability * static_cast<double>(infinite_.probability(place.path)));
        }
        const std::size_t child = path % width;
        path >>= bits_per_level;
        probability *= here.of(child) / here.total();
        node = nodes_[node].child[child];
        if (node & emitter_bit) return static_cast<float>(probability);
    }
}

} // namespace plumb
