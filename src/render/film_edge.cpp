// SPDX-License-Identifier: MIT
#include "render/film_edge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace plumb {

namespace {

constexpr std::size_t cells_of_edge = 2048;

} // namespace

FilmEdge::Profile::Profile(const Filter& filter, double begin, double end)
    : begin_(begin), width_((end - begin) / static_cast<double>(cells_of_edge)), negative_(cells_of_edge)
{
    std::vector<double> weights(cells_of_edge);
    double integral = 0.0;
    for (std::size_t i = 0; i < cells_of_edge; ++i) {
        const double offset = begin + (static_cast<double>(i) + 0.5) * width_;
        // Filters are separable: along the axis, all are the same but for a factor.
        const auto value = static_cast<double>(filter.evaluate({static_cast<float>(offset), 0.f}));
        weights[i] = std::abs(value);
        negative_[i] = value < 0.0;
        integral += value;
    }
    distribution_ = DiscreteDistribution(weights);
    weight_ = static_cast<float>(distribution_.sum() / integral);
}

FilmEdge::Profile::Draw FilmEdge::Profile::sample(float u) const
{
    const DiscreteDistribution::Choice choice = distribution_.sample(u);
    return {static_cast<float>(begin_ + (choice.index + choice.u) * width_),
            negative_[choice.index] ? -weight_ : weight_};
}

FilmEdge::FilmEdge(const Filter& filter, const Camera& camera) : filter_(filter)
{
    if (camera.sample_border()) return;
    const double radius = filter.radius();
    profiles_.emplace_back(filter, -radius, radius);
    const Vec2i size = camera.resolution();
    columns_ = cut(size.x);
    rows_ = cut(size.y);
}

std::vector<std::uint32_t> FilmEdge::cut(int size)
{
    const double radius = filter_.radius();
    std::map<std::pair<double, double>, std::uint32_t> known;
    std::vector<std::uint32_t> result(static_cast<std::size_t>(size), whole);
    for (int i = 0; i < size; ++i) {
        const double before = i + 0.5, after = size - before; // from the pixel's middle to the edges
        if (before >= radius && after >= radius) continue;
        const std::pair range(std::max(-radius, -before), std::min(radius, after));
        const auto [at, is_new] = known.emplace(range, static_cast<std::uint32_t>(profiles_.size()));
        if (is_new) profiles_.emplace_back(filter_, range.first, range.second);
        result[static_cast<std::size_t>(i)] = at->second;
    }
    return result;
}

} // namespace plumb
