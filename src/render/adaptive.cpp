// SPDX-License-Identifier: MIT

#include "plumb/render/adaptive.h"

#include "plumb/model/sampler.h"

#include <algorithm>
#include <cmath>

namespace plumb {

namespace {

constexpr double sqrt_2 = 1.4142135623730951;

} // namespace

// The power of two that is nearest to 1 / target^2, by its logarithm.
AdaptiveRule::AdaptiveRule(double target) : usual_(least_adaptive_samples)
{
    while (usual_ < max_samples_per_pixel && static_cast<double>(usual_) * sqrt_2 * target * target < 1.0)
        usual_ *= 2;
}

std::uint64_t AdaptiveRule::least() const
{
    return std::max(usual_ / 2, least_adaptive_samples);
}

std::uint64_t AdaptiveRule::pilot_size() const
{
    return std::max(usual_ / 32, least_adaptive_samples);
}

std::uint64_t AdaptiveRule::samples(std::span<const double> pilot) const
{
    const auto size = static_cast<double>(pilot.size());
    double mean = 0.0;
    for (const double value : pilot) mean += value / size;
    double distance = 0.0;
    for (const double value : pilot) distance += std::abs(value - mean) / size;
    const double deviation = distance / std::max(mean, adaptive_floor);
    // The power of two that is nearest to usual deviation^(2/3): numbers above sqrt(2) times one belong to the next. In
    // third powers, which need no root.
    std::uint64_t samples = least();
    const auto is_too_few = [&] {
        const double ratio = sqrt_2 * static_cast<double>(samples) / static_cast<double>(usual_);
        return ratio * ratio * ratio < deviation * deviation;
    };
    while (samples < max_samples_per_pixel && is_too_few()) samples *= 2;
    return samples;
}

} // namespace plumb
