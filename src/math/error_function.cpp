// SPDX-License-Identifier: MIT

#include "plumb/math/elementary.h"

#include <algorithm>
#include <cmath>

namespace plumb {

// Abramowitz and Stegun 7.1.6: a series whose terms are all positive.
double erf(double x)
{
    constexpr double two_over_sqrt_pi = 0x1.20dd750429b6dp+0;
    if (std::isnan(x)) return x;
    if (std::abs(x) >= 6.0) return x < 0.0 ? -1.0 : 1.0; // 1 - erf(6) = 2e-17
    const double x2 = x * x;
    double sum = 1.0;
    double term = 1.0;
    for (double n = 3.0; term > 0x1p-60 * sum; n += 2.0) {
        term *= 2.0 * x2 / n;
        sum += term;
    }
    return std::clamp(two_over_sqrt_pi * x * exp(-x2) * sum, -1.0, 1.0);
}

} // namespace plumb
