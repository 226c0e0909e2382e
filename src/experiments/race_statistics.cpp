// SPDX-License-Identifier: MIT

// References:
//  [1] Efron, B., Stein, C.: The Jackknife Estimate of Variance. Annals of Statistics 9(3), 1981.

#include "plumb/experiments/race.h"

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

// Of logarithms: of all n rounds, and without each of them.
Bounded with_interval(double middle, const MeanAndVariance& shortened, double n)
{
    // [1, equation 1.2]
    const double deviation = std::sqrt(shortened.variance() * (n - 1.0) * (n - 1.0) / n);
    const double half = student_t_quantile(0.05, n - 1.0) * deviation;
    return Bounded{exp(middle), exp(middle - half), exp(middle + half)};
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

std::optional<Bounded> efficiency_ratio(const Rounds& one, const Rounds& other)
{
    const std::size_t count = one.seconds.size();
    MeanAndVariance shortened; // the ratios' logarithms, each without one round
    for (std::size_t i = 0; i < count; ++i) {
        const Rounds a = without(one, i);
        const Rounds b = without(other, i);
        if (!(a.variance() > 0.0 && b.variance() > 0.0)) return {};
        shortened.add(log_cost(b) - log_cost(a));
    }
    return with_interval(log_cost(other) - log_cost(one), shortened, static_cast<double>(count));
}

std::optional<Bounded> rmse_of_spread(const Rounds& rounds)
{
    MeanAndVariance shortened;
    for (std::size_t i = 0; i < rounds.seconds.size(); ++i) {
        const double variance = without(rounds, i).variance();
        if (!(variance > 0.0)) return {};
        shortened.add(0.5 * log(variance));
    }
    if (!(rounds.variance() > 0.0)) return {};
    return with_interval(0.5 * log(rounds.variance()), shortened, static_cast<double>(rounds.seconds.size()));
}

std::optional<Bounded> rmse_of_errors(const std::vector<double>& squared_errors)
{
    const auto n = static_cast<double>(squared_errors.size());
    const double sum = sum_of(squared_errors);
    MeanAndVariance shortened;
    for (const double error : squared_errors) {
        if (!(sum - error > 0.0)) return {};
        shortened.add(0.5 * log((sum - error) / (n - 1.0)));
    }
    if (!(sum > 0.0)) return {};
    return with_interval(0.5 * log(sum / n), shortened, n);
}

} // namespace plumb
