// SPDX-License-Identifier: MIT
#pragma once

// The test of one square of pixels: could both images have the same expectation there? Numbers of papers: see
// plumb/compare/compare.h.

#include "compare/estimate.h"

namespace plumb {

// What an image tells about one channel of a square: sums over its pixels.
struct SideSums {
    double mean = 0.0;
    double variance = 0.0; // of the mean
    double largest = 0.0;  // variance of a pixel
    double square = 0.0;   // of variance + mean^2 / samples: the sum of the samples' squares, so to say
    double inverse_freedom = 0.0; // of variance^2 / degrees of freedom

    // contributing: samples that were not black, or infinite. freedom: degrees of freedom of the variance; absent:
    // samples - 1.
    void add(double pixel_mean, double pixel_variance, std::optional<double> samples, double contributing,
             std::optional<double> freedom = {});

    // How many equal samples would have this spread [3]: few where few paths carry the light.
    double effective_samples() const;
    // Of the estimated variance [2]: at most half the effective samples, as of exponential ones.
    double degrees_of_freedom() const;
    bool is_black() const { return mean == 0.0 && variance == 0.0; }
};

struct UnitSums {
    SideSums a;
    SideSums b;
    std::uint64_t pixels = 0;
};

// How the two images were made.
struct Sampling {
    std::optional<double> samples_a;
    std::optional<double> samples_b;
    bool a_is_exact = false;
    bool b_is_exact = false;
    double rounding = 0.0;
    double inflation_a = 1.0; // the noise of neighbours is correlated: of a sum's variance
    double inflation_b = 1.0;

    // What one image tells of the noise of a sample can be told of the other's.
    bool noise_is_shared() const { return samples_a && samples_b && !a_is_exact && !b_is_exact; }
};

// Whether a test of the square may be trusted: from both images, enough effective samples and degrees of freedom,
// and no pixel that has most of the noise.
bool is_supported(const UnitSums& sums, const Sampling& sampling);
// Nothing to see in either.
inline bool is_black(const UnitSums& sums)
{
    return sums.a.is_black() && sums.b.is_black();
}

struct Deviation {
    double t = 0.0; // difference of A and B in standard errors
    double freedom = 0.0;
    double standard_error = 0.0; // relative to the larger of both sums
};

// What the surroundings of a small square tell of its noise, as rare bright samples may all have been missed in it: a
// pixel's variance is not below these.
struct LeastNoise {
    double a = 0.0;
    double b = 0.0;
};

// Of a supported square. An image that has missed rare bright samples in the whole square does not know its noise, but
// the other one may: samples of either are taken to be as noisy as the noisier ones.
Deviation deviation(const UnitSums& sums, const Sampling& sampling, const std::optional<LeastNoise>& least);

} // namespace plumb
