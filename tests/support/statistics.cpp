// SPDX-License-Identifier: MIT

#include "support/statistics.h"

#include "support/catch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::test {

namespace {

constexpr double tiny = 1e-300;
constexpr double machine_epsilon = std::numeric_limits<double>::epsilon();

// Numerical Recipes, equation 6.2.5: the series for P.
double gamma_p_series(double a, double x)
{
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; std::abs(term) > std::abs(sum) * machine_epsilon; n += 1.0) {
        term *= x / n;
        sum += term;
    }
    return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

// Numerical Recipes, equation 6.2.7: the continued fraction for Q, by Lentz's method.
double gamma_q_fraction(double a, double x)
{
    double b = x + 1.0 - a;
    double c = 1.0 / tiny;
    double d = 1.0 / b;
    double h = d;
    for (double i = 1.0; i < 1e6; i += 1.0) {
        const double an = -i * (i - a);
        b += 2.0;
        d = an * d + b;
        if (std::abs(d) < tiny) d = tiny;
        c = b + an / c;
        if (std::abs(c) < tiny) c = tiny;
        d = 1.0 / d;
        const double factor = d * c;
        h *= factor;
        if (std::abs(factor - 1.0) < machine_epsilon) break;
    }
    return std::exp(-x + a * std::log(x) - std::lgamma(a)) * h;
}

// Numerical Recipes, equation 6.4.5: the continued fraction of the incomplete beta function.
double beta_fraction(double a, double b, double x)
{
    double c = 1.0;
    double d = 1.0 - (a + b) * x / (a + 1.0);
    if (std::abs(d) < tiny) d = tiny;
    d = 1.0 / d;
    double h = d;
    for (double m = 1.0; m < 1e6; m += 1.0) {
        const double numerators[] = {m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)),
                                     -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))};
        double factor = 1.0;
        for (const double numerator : numerators) {
            d = 1.0 + numerator * d;
            if (std::abs(d) < tiny) d = tiny;
            c = 1.0 + numerator / c;
            if (std::abs(c) < tiny) c = tiny;
            d = 1.0 / d;
            factor = d * c;
            h *= factor;
        }
        if (std::abs(factor - 1.0) < machine_epsilon) break;
    }
    return h;
}

double regularised_beta(double a, double b, double x)
{
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
    return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

Outcome difference_outcome(double difference, double allowed, double standard_error, double dof,
                           const std::string& text)
{
    const double excess = std::abs(difference) - allowed;
    double p = 1.0;
    if (!std::isfinite(difference))
        p = 0.0;
    else if (excess > 0.0)
        p = standard_error > 0.0 ? student_t_two_sided(excess / standard_error, dof) : 0.0;
    return {p, text};
}

} // namespace

double regularised_gamma_p(double a, double x)
{
    if (x <= 0.0) return 0.0;
    return x < a + 1.0 ? gamma_p_series(a, x) : 1.0 - gamma_q_fraction(a, x);
}

double regularised_gamma_q(double a, double x)
{
    if (x <= 0.0) return 1.0;
    return x < a + 1.0 ? 1.0 - gamma_p_series(a, x) : gamma_q_fraction(a, x);
}

double chi2_survival(double statistic, double degrees_of_freedom)
{
    return regularised_gamma_q(degrees_of_freedom / 2.0, statistic / 2.0);
}

double normal_survival(double z)
{
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

double binomial_survival(std::uint64_t count, std::uint64_t trials, double chance)
{
    const double n = static_cast<double>(trials);
    double survival = 0.0;
    for (std::uint64_t k = count; k <= trials; ++k) {
        const double x = static_cast<double>(k);
        survival += std::exp(std::lgamma(n + 1) - std::lgamma(x + 1) - std::lgamma(n - x + 1) +
                             x * std::log(chance) + (n - x) * std::log1p(-chance));
    }
    return std::min(1.0, survival);
}

double student_t_two_sided(double t, double degrees_of_freedom)
{
    // The logarithms of the gamma functions below would cancel.
    if (degrees_of_freedom > 1e7) return 2.0 * normal_survival(std::abs(t));
    return regularised_beta(degrees_of_freedom / 2.0, 0.5, degrees_of_freedom / (degrees_of_freedom + t * t));
}

double sidak_level(double level, std::size_t tests)
{
    return -std::expm1(std::log1p(-level) / static_cast<double>(tests));
}

bool check_statistic(const std::string& name, const std::function<Outcome(std::uint64_t, std::uint64_t)>& run,
                     std::uint64_t samples, double level, std::uint64_t seed)
{
    Outcome outcome = run(samples, seed);
    std::string text = fmt::format("{}: p = {}", outcome.text, outcome.p);
    if (!(outcome.p >= level)) {
        outcome = run(samples * 100, seed + 0x5eed);
        text +=
            "\nrepeated with 100 times the samples: " + outcome.text + ": p = " + std::to_string(outcome.p);
    }
    INFO(name << "\n" << text);
    CHECK(outcome.p >= level);
    return outcome.p >= level;
}

Outcome mean_outcome(const MeanAndVariance& estimate, double expected, double relative_rounding)
{
    const std::string text = fmt::format("mean of {} samples: {} +- {}, expected {}", estimate.count(),
                                         estimate.mean(), estimate.standard_error(), expected);
    return difference_outcome(estimate.mean() - expected, relative_rounding * std::abs(expected),
                              estimate.standard_error(), static_cast<double>(estimate.count() - 1), text);
}

bool check_mean(const std::string& name, double expected, const Estimate& estimate, std::uint64_t samples,
                double level, std::uint64_t seed, double relative_rounding)
{
    const auto run = [&](std::uint64_t n, std::uint64_t s) {
        return mean_outcome(estimate(n, s), expected, relative_rounding);
    };
    return check_statistic(name, run, samples, level, seed);
}

bool check_same_mean(const std::string& name, const Estimate& a, const Estimate& b, std::uint64_t samples,
                     double level, std::uint64_t seed)
{
    const auto run = [&](std::uint64_t n, std::uint64_t first_seed) {
        return same_mean_outcome(a(n, first_seed), b(n, first_seed + 1000), 1e-5);
    };
    return check_statistic(name, run, samples, level, seed);
}

Outcome same_mean_outcome(const MeanAndVariance& a, const MeanAndVariance& b, double relative_rounding)
{
    const double va = a.variance() / static_cast<double>(a.count());
    const double vb = b.variance() / static_cast<double>(b.count());
    const double weights =
        va * va / static_cast<double>(a.count() - 1) + vb * vb / static_cast<double>(b.count() - 1);
    const double dof = weights > 0.0 ? (va + vb) * (va + vb) / weights : 1.0; // Welch and Satterthwaite
    const std::string text =
        fmt::format("means: {} +- {} and {} +- {}", a.mean(), std::sqrt(va), b.mean(), std::sqrt(vb));
    const double larger = std::max(std::abs(a.mean()), std::abs(b.mean()));
    return difference_outcome(a.mean() - b.mean(), relative_rounding * larger, std::sqrt(va + vb), dof, text);
}

} // namespace plumb::test
