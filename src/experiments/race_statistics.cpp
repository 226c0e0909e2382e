// SPDX-License-Identifier: MIT

// References:
//  [1] Efron, B., Stein, C.: The Jackknife Estimate of Variance. Annals of Statistics 9(3), 1981.

#include "plumb/experiments/agree.h"

#include "plumb/math/elementary.h"
#include "plumb/statistics/mean_and_variance.h"
#include "plumb/statistics/statistics.h"

#include <numeric>

namespace plumb {

namespace {

double sum_of(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

// Without an image of n, the mean of the others is away from it by d n / (n - 1), where d is its distance from the mean of
// all: the sum of squared deviations is less by d^2 n / (n - 1).
Rounds without(Rounds rounds, std::size_t left_out)
{
    const auto n = static_cast<double>(rounds.seconds.size());
    const double sum = sum_of(rounds.deviations) - rounds.deviations[left_out] * n / (n - 1.0);
    rounds.seconds.erase(rounds.seconds.begin() + static_cast<std::ptrdiff_t>(left_out));
    rounds.deviations.assign(rounds.seconds.size(), sum / (n - 1.0));
    return rounds;
}

double log_cost(const Rounds& rounds)
{
    return log(rounds.mean_seconds() * rounds.variance());
}

} // namespace

double Rounds::mean_seconds() const
{
    return sum_of(seconds) / static_cast<double>(seconds.size());
}

double Rounds::variance() const
{
    return sum_of(deviations) / static_cast<double>(deviations.size() - 1);
}

std::optional<Ratio> efficiency_ratio(const Rounds& one, const Rounds& other)
{
    const std::size_t count = one.seconds.size();
    MeanAndVariance shortened; // the ratios' logarithms, each without one round
    for (std::size_t i = 0; i < count; ++i) {
        const Rounds a = without(one, i);
        const Rounds b = without(other, i);
        if (!(a.variance() > 0.0 && b.variance() > 0.0)) return {};
        shortened.add(log_cost(b) - log_cost(a));
    }
    // [1, equation 1.2]
    const auto n = static_cast<double>(count);
    const double deviation = std::sqrt(shortened.variance() * (n - 1.0) * (n - 1.0) / n);
    const double middle = log_cost(other) - log_cost(one);
    const double half = student_t_quantile(0.05, n - 1.0) * deviation;
    return Ratio{exp(middle), exp(middle - half), exp(middle + half)};
}

} // namespace plumb
