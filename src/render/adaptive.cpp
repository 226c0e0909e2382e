// SPDX-License-Identifier: MIT

#include "plumb/render/adaptive.h"

#include "plumb/model/sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace plumb {

void Pilot::add(double value)
{
    block_sum_ += value;
    if (++size_ % block != 0) return;
    const double mean = block_sum_ / static_cast<double>(block);
    block_sum_ = 0.0;
    blocks_ += 1.0;
    const double delta = mean - mean_;
    mean_ += delta / blocks_;
    squares_ += delta * (mean - mean_);
}

std::uint64_t Pilot::wanted(double target) const
{
    const double variance = static_cast<double>(block) * squares_ / (blocks_ - 1.0);
    const double relative = std::sqrt(variance) / std::max(mean_, adaptive_floor);
    const double samples = 16.0 * relative / target;
    std::uint64_t power = least_adaptive_samples;
    while (static_cast<double>(power) * 1.4142135623730951 < samples && power < max_samples_per_pixel) power *= 2;
    return power;
}

PixelPlan plan_pixel(double target, std::uint64_t maximum, const std::function<double(std::uint64_t)>& take)
{
    if (maximum <= least_adaptive_samples) return {least_adaptive_samples, false};
    Pilot pilot;
    std::uint64_t least = least_adaptive_samples;
    for (std::uint64_t size = first_pilot;; size *= 2) {
        while (pilot.size() < size) pilot.add(take(pilot.size()));
        const std::uint64_t most = samples_per_pilot_sample * size;
        if (const std::uint64_t wanted = pilot.wanted(target); wanted <= most)
            return {std::max(wanted, least), true};
        least = most;
        if (most >= maximum) return {most, false};
    }
}

} // namespace plumb
