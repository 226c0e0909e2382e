// SPDX-License-Identifier: MIT
#pragma once

// Whether things are chosen as often as their probabilities say.

#include "plumb/math/math.h"
#include "support/statistics.h"

#include <fmt/format.h>
#include <vector>

namespace plumb::test {

// How often each thing was chosen in so many samples, and its chance. Those of which fewer than 5 are expected are one cell.
inline Outcome choice_outcome(const std::vector<double>& chosen, const std::vector<double>& chances,
                              std::uint64_t samples)
{
    double statistic = 0.0;
    double pooled_chance = 0.0;
    double pooled = 0.0;
    int cells = 0;
    const auto add = [&](double observed, double expected) {
        statistic += sqr(observed - expected) / expected;
        ++cells;
    };
    const auto all = static_cast<double>(samples);
    for (std::size_t i = 0; i < chances.size(); ++i) {
        if (chances[i] * all >= 5.0) {
            add(chosen[i], chances[i] * all);
        } else {
            pooled_chance += chances[i];
            pooled += chosen[i];
        }
    }
    if (pooled_chance * all >= 5.0) add(pooled, pooled_chance * all);
    if (pooled_chance == 0.0 && pooled > 0.0) return {0.0, "something impossible was chosen"};
    const double p = cells > 1 ? chi2_survival(statistic, cells - 1) : 1.0;
    return {p, fmt::format("chi2 {} with {} cells", statistic, cells)};
}

} // namespace plumb::test
