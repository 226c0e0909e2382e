// SPDX-License-Identifier: MIT

// [1] Chen and Asau 1974, "On Generating Random Variates from an Empirical Distribution", AIIE Transactions 6(2).

#include "plumb/sampling/distribution.h"

#include <algorithm>
#include <cmath>

namespace plumb {

DiscreteDistribution::DiscreteDistribution(std::span<const double> weights)
{
    // Relative to the largest weight, so that sums of huge weights cannot overflow nor tiny ones vanish.
    const double largest = weights.empty() ? 0.0 : *std::max_element(weights.begin(), weights.end());
    const double unit = largest > 0.0 ? largest : 1.0;
    cdf_.resize(weights.size() + 1);
    cdf_[0] = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) cdf_[i + 1] = cdf_[i] + weights[i] / unit;
    const double total = cdf_.back();
    sum_ = total * unit;
    if (!(total > 0.0)) return;
    // Division keeps the order, and makes the end of the last thing that has a weight, and of all after it, exactly 1.
    // Ends are multiples of 2^-53, as random numbers are, so that each thing is chosen exactly as often as it says.
    for (double& x : cdf_) x = std::floor(x / total * 0x1p53) * 0x1p-53;

    if (size() < 2) return;
    guide_.reserve(size());
    std::uint32_t end = 1;
    for (std::size_t bucket = 0; bucket < size(); ++bucket) {
        while (bucket_of(cdf_[end]) < bucket) ++end;
        guide_.push_back(end);
    }
}

DiscreteDistribution::Choice DiscreteDistribution::sample_several(double u) const
{
    // The first end above u belongs to an interval that is not empty: it begins at or below u. It is the first end in u's
    // bucket or a later one [1]: one step in the mean.
    const double clamped = std::clamp(u, 0.0, largest_below_one);
    std::uint32_t end = guide_[bucket_of(clamped)];
    while (cdf_[end] <= clamped) ++end;
    const std::uint32_t index = end - 1;
    const double low = cdf_[index];
    const double width = cdf_[end] - low;
    return {index, static_cast<float>(width), std::min((clamped - low) / width, largest_below_one)};
}

std::optional<DiscreteDistribution::Pick> DiscreteDistribution::sample_among(std::size_t first,
                                                                             std::size_t last, double u) const
{
    const double all = cdf_[last] - cdf_[first];
    if (!(all > 0.0)) return std::nullopt;
    // Ends are multiples of 2^-53: the sum is rounded to no more than the last of them, and must not be that.
    const double place = std::min(cdf_[first] + u * all, cdf_[last] - 0x1p-53);
    const std::uint32_t index = sample(place).index;
    return Pick{index, share_among(index, first, last)};
}

} // namespace plumb
