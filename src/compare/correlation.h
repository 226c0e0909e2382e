// SPDX-License-Identifier: MIT
#pragma once

// How far the noise of an image is correlated: a filter that splats a sample into many pixels, or a denoiser.
//
// The autocorrelation rho(l) is estimated in squares of 32x32 pixels, from each of which its mean is subtracted, and
// the median of the squares counts. So a difference that is nearly constant in most squares, as that of a wrong
// albedo, is no correlation. In a square of n values the products of two different values have the mean
// -M2 / (n (n - 1)) if the values are exchangeable, whatever their distribution (M2: sum of the squared deviations);
// if they are correlated, it is larger in proportion to the inflation. Both are corrected for.

#include <optional>
#include <vector>

namespace plumb {

struct Correlation {
    // Variance of the sum over a large square divided by the sum of the variances: 1 + sum of rho(l) over all l != 0,
    // and one standard error of that. 1 or more.
    double inflation = 1.0;
    // Largest distance with a significant correlation, in pixels. Nothing: it reaches farther than was looked at.
    std::optional<int> reach = 0;
};

// values: width * height, row by row; finite.
Correlation measure_correlation(const std::vector<double>& values, int width, int height);

} // namespace plumb
