// SPDX-License-Identifier: MIT
#include "compare/region_test.h"

namespace plumb {

namespace {

// Found by simulation (tests/statistical/compare_test.cpp): with these, the error rate holds.
constexpr double least_effective_samples = 32.0;
constexpr double least_freedom = 16.0;
constexpr double largest_pixel_share = 0.5;

bool is_supported(const SideSums& sums, std::uint64_t pixels, double inflation)
{
    if (sums.effective_samples() < least_effective_samples) return false;
    if (sums.degrees_of_freedom() < least_freedom * inflation) return false;
    return pixels == 1 || sums.largest <= largest_pixel_share * sums.variance;
}

} // namespace

void SideSums::add(double pixel_mean, double pixel_variance, std::optional<double> samples,
                   double contributing, std::optional<double> freedom)
{
    const double pixel_square = pixel_variance + (samples ? sqr(pixel_mean) / *samples : 0.0);
    mean += pixel_mean;
    variance += pixel_variance;
    largest = std::max(largest, pixel_variance);
    square += pixel_square;
    if (!(pixel_variance > 0.0)) return;
    const double effective = std::clamp(sqr(pixel_mean) / pixel_square, 1.0, std::max(1.0, contributing));
    const double most = freedom   ? *freedom
                        : samples ? std::max(*samples - 1.0, 0.5)
                                  : static_cast<double>(infinity);
    inverse_freedom += sqr(pixel_variance) / std::min(most, 0.5 * effective);
}

double SideSums::effective_samples() const
{
    return square > 0.0 ? sqr(mean) / square : 0.0;
}

double SideSums::degrees_of_freedom() const
{
    const double most = 0.5 * effective_samples();
    return inverse_freedom > 0.0 ? std::min(most, sqr(variance) / inverse_freedom) : most;
}

bool is_supported(const UnitSums& sums, const Sampling& sampling)
{
    const bool is_sum = sums.pixels > 1;
    return sums.pixels > 0 &&
           (sampling.a_is_exact || is_supported(sums.a, sums.pixels, is_sum ? sampling.inflation_a : 1.0)) &&
           (sampling.b_is_exact || is_supported(sums.b, sums.pixels, is_sum ? sampling.inflation_b : 1.0));
}

Deviation deviation(const UnitSums& sums, const Sampling& sampling, const std::optional<LeastNoise>& least)
{
    const double mean_a = std::abs(sums.a.mean);
    const double mean_b = std::abs(sums.b.mean);
    const double larger = std::max(mean_a, mean_b);
    const double pixels = static_cast<double>(sums.pixels);
    double variance_a = std::max(sums.a.variance, least ? pixels * least->a : 0.0);
    double variance_b = std::max(sums.b.variance, least ? pixels * least->b : 0.0);

    if (sums.pixels > 1) {
        variance_a *= sampling.inflation_a;
        variance_b *= sampling.inflation_b;
    }
    // Where both have the same expectation, it is more likely the larger mean: the noise of the smaller one, which
    // has missed light, would have been larger in proportion.
    if (mean_a > 0.0) variance_a *= sqr(larger / mean_a);
    if (mean_b > 0.0) variance_b *= sqr(larger / mean_b);
    if (sampling.a_is_exact) variance_a = 0.0;
    if (sampling.b_is_exact) variance_b = 0.0;
    // One noise for both is known no better than by the fewer degrees of freedom.
    double inverse_freedom = 0.0;
    if (sampling.noise_is_shared()) {
        const double ratio = *sampling.samples_b / *sampling.samples_a;
        const bool from_a = variance_a >= variance_b * ratio;
        if (from_a)
            variance_b = variance_a / ratio;
        else
            variance_a = variance_b * ratio;
        if (variance_a > 0.0)
            inverse_freedom = 1.0 / std::min(sums.a.degrees_of_freedom(), sums.b.degrees_of_freedom());
    }
    const double variance = variance_a + variance_b;
    if (!sampling.noise_is_shared()) {
        const bool is_sum = sums.pixels > 1;
        if (variance_a > 0.0)
            inverse_freedom += sqr(variance_a / variance) * (is_sum ? sampling.inflation_a : 1.0) /
                               sums.a.degrees_of_freedom();
        if (variance_b > 0.0)
            inverse_freedom += sqr(variance_b / variance) * (is_sum ? sampling.inflation_b : 1.0) /
                               sums.b.degrees_of_freedom();
    }

    // Welch's t [1], but for what rounding may have done.
    Deviation result;
    const double difference = sums.a.mean - sums.b.mean;
    const double beyond = std::max(0.0, std::abs(difference) - sampling.rounding * larger);
    result.standard_error = larger > 0.0 ? std::sqrt(variance) / larger : 0.0;
    if (beyond > 0.0)
        result.t = std::copysign(
            variance > 0.0 ? beyond / std::sqrt(variance) : static_cast<double>(infinity), difference);
    result.freedom = inverse_freedom > 0.0 ? 1.0 / inverse_freedom : static_cast<double>(infinity);
    return result;
}

} // namespace plumb
