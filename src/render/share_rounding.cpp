// SPDX-License-Identifier: MIT

#include "render/share_rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>

namespace plumb {
namespace {

// In units of the distance between a float and its nearer neighbour. A sum that is so close to the float rounds to it, also
// if its terms are added in another order.
constexpr double close = 0.4;

double gap_at(float value)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const double above = static_cast<double>(std::nextafter(value, infinity)) - static_cast<double>(value);
    const double below = static_cast<double>(value) - static_cast<double>(std::nextafter(value, -infinity));
    return std::min(above, below);
}

// One change is enough, unless the share has an exponent like the total's, whose rounding may be half a unit.
void make_add_up(std::vector<std::size_t> places, float* layers, float total)
{
    double rest = static_cast<double>(total);
    for (const std::size_t place : places) rest -= static_cast<double>(layers[place]);
    const double allowed = close * gap_at(total);
    if (!(std::abs(rest) > allowed)) return;
    std::ranges::stable_sort(places, std::greater(),
                             [&](std::size_t place) { return std::abs(layers[place]); });
    for (const std::size_t place : places) {
        const auto changed = static_cast<float>(static_cast<double>(layers[place]) + rest);
        rest -= static_cast<double>(changed) - static_cast<double>(layers[place]);
        layers[place] = changed;
        if (!(std::abs(rest) > allowed)) return;
    }
}

} // namespace

std::vector<ShareFamily> share_families(const ChannelSet& layers)
{
    std::vector<ShareFamily> families;
    std::unordered_map<std::string_view, std::size_t> index_of;
    std::size_t place = 0;
    for (const Layer& layer : layers) {
        if (layer.kind == LayerKind::share) {
            const std::size_t index = index_of.emplace(family_of(layer), families.size()).first->second;
            if (index == families.size()) families.emplace_back();
            for (std::size_t c = 0; c < 3; ++c) families[index].places[c].push_back(place + c);
        }
        place += layer.components.size();
    }
    return families;
}

void make_shares_add_up(const ShareFamily& family, float* layers, const float* beauty)
{
    for (std::size_t c = 0; c < 3; ++c) make_add_up(family.places[c], layers, beauty[c]);
}

} // namespace plumb
