// SPDX-License-Identifier: MIT

#include "shapes/triangle_tree.h"

#include "model/light_estimate.h"
#include "shapes/triangle_lanes.h"

#include <algorithm>

namespace plumb {
namespace {

constexpr double largest_below_one = 0x1.fffffffffffffp-1;

// The lane that a number in [0, 1) falls into, and what is left of the number.
struct LaneChoice {
    std::size_t lane;
    double u;
};

double share(const LightLanes::Sums& sums, std::size_t lane)
{
    return (sums[lane + 1] - sums[lane]) / sums.back();
}

// Nothing if all sums are 0.
std::optional<LaneChoice> choose_lane(const LightLanes::Sums& sums, double u)
{
    if (!(sums.back() > 0.0)) return std::nullopt;
    const double target = u * sums.back(); // below the total, however it is rounded
    std::size_t lane = 0;
    for (std::size_t k = 1; k < LightLanes::width; ++k) lane += sums[k] <= target ? 1 : 0;
    return LaneChoice{lane,
                      std::min((target - sums[lane]) / (sums[lane + 1] - sums[lane]), largest_below_one)};
}

} // namespace

std::uint32_t TriangleTree::Clusters::parts() const
{
    if (count <= width) return count;
    std::uint64_t of_a_child = width;
    while (of_a_child * width < count) of_a_child *= width;
    return static_cast<std::uint32_t>((count + of_a_child - 1) / of_a_child);
}

TriangleTree::Clusters TriangleTree::Clusters::part(std::uint32_t k) const
{
    const std::uint64_t all = parts();
    const std::uint64_t begin = std::uint64_t{count} * k / all;
    const std::uint64_t end = std::uint64_t{count} * (k + 1) / all;
    return {static_cast<std::uint32_t>(first + begin), static_cast<std::uint32_t>(end - begin)};
}

std::uint32_t TriangleTree::Clusters::part_of(std::uint32_t cluster) const
{
    return static_cast<std::uint32_t>(((cluster - first + std::uint64_t{1}) * parts() - 1) / count);
}

// Farther away than floats can tell, a receiver sees what it would see from there.
LaneReceiver TriangleTree::to_lanes(const LightReceiver& receiver) const
{
    constexpr double furthest = 1e12;
    Vec3d position = (Vec3d(receiver.position) - space_.origin) * space_.scale;
    const double distance = length(position);
    if (distance > furthest) position *= furthest / distance;
    return {Vec3f(position), receiver.normal};
}

LightLanes TriangleTree::triangles_of(std::uint32_t cluster) const
{
    const std::uint32_t first = first_place(cluster);
    const std::uint32_t count = first_place(cluster + 1) - first;
    return lanes_of(mesh_, std::span(order_).subspan(first, count), space_, area_);
}

LightLanes::Sums TriangleTree::importance_in(std::uint32_t cluster, const LaneReceiver& at) const
{
    return kept_.empty() ? triangles_of(cluster).importance(at) : kept_[cluster].importance(at);
}

std::optional<TriangleTree::Choice> TriangleTree::choose(const LightReceiver& receiver, double u) const
{
    const LaneReceiver at = to_lanes(receiver);
    double probability = 1.0;
    Clusters here{0, clusters_};
    std::uint32_t node = 0;
    u = std::min(u, largest_below_one);
    while (here.count > 1) {
        const LightLanes& lights = nodes_[node].lights;
        const LightLanes::Sums sums = expected_importance(lights, at);
        const auto choice = choose_lane(sums, u);
        if (!choice) return std::nullopt;
        const auto child = static_cast<std::uint32_t>(choice->lane);
        u = choice->u;
        probability *= share(sums, child);
        here = here.part(child);
        if (lights.looks_alike(child, at)) {
            const auto place =
                by_area_.sample_among(first_place(here.first), first_place(here.first + here.count), u);
            if (!place) return std::nullopt;
            return Choice{order_[place->index], probability * place->share};
        }
        node = nodes_[node].child[child];
    }
    const LightLanes::Sums sums = importance_in(here.first, at);
    const auto choice = choose_lane(sums, u);
    if (!choice) return std::nullopt;
    const auto place = first_place(here.first) + static_cast<std::uint32_t>(choice->lane);
    return Choice{order_[place], probability * share(sums, choice->lane)};
}

double TriangleTree::probability(const LightReceiver& receiver, std::uint32_t triangle) const
{
    const LaneReceiver at = to_lanes(receiver);
    const std::uint32_t place = place_[triangle];
    const std::uint32_t cluster = cluster_at(place);
    double probability = 1.0;
    Clusters here{0, clusters_};
    std::uint32_t node = 0;
    while (here.count > 1) {
        const LightLanes& lights = nodes_[node].lights;
        const LightLanes::Sums sums = expected_importance(lights, at);
        const std::uint32_t child = here.part_of(cluster);
        if (!(sums[child + 1] > sums[child])) return 0.0;
        probability *= share(sums, child);
        here = here.part(child);
        if (lights.looks_alike(child, at))
            return probability *
                   by_area_.share_among(place, first_place(here.first), first_place(here.first + here.count));
        node = nodes_[node].child[child];
    }
    const LightLanes::Sums sums = importance_in(here.first, at);
    const std::uint32_t lane = place - first_place(here.first);
    return sums[lane + 1] > sums[lane] ? probability * share(sums, lane) : 0.0;
}

std::uint64_t TriangleTree::memory_bytes() const
{
    return (order_.capacity() + place_.capacity()) * sizeof(std::uint32_t) +
           nodes_.capacity() * sizeof(Node) + kept_.capacity() * sizeof(LightLanes) + by_area_.memory_bytes();
}

} // namespace plumb
