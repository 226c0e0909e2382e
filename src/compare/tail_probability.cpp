// SPDX-License-Identifier: MIT
#include "compare/tail_probability.h"

#include "plumb/elementary.h"
#include "plumb/math.h"

namespace plumb {

namespace {

// Stands for a denominator of 0 in a continued fraction.
constexpr double tiny = 1e-300;

double not_zero(double x)
{
    return std::abs(x) < tiny ? tiny : x;
}

// [1], equation 6.4.5, evaluated by Lentz's method.
double beta_fraction(double a, double b, double x)
{
    double c = 1.0;
    double d = 1.0 / not_zero(1.0 - (a + b) * x / (a + 1.0));
    double result = d;
    for (int m = 1; m < 20000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
        d = 1.0 / not_zero(1.0 + even * d);
        c = not_zero(1.0 + even / c);
        result *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
        d = 1.0 / not_zero(1.0 + odd * d);
        c = not_zero(1.0 + odd / c);
        result *= d * c;
        if (std::abs(d * c - 1.0) < 1e-15) break;
    }
    return result;
}

} // namespace

double log_gamma(double x)
{
    // Stirling's series [2] where it converges; below, the recurrence.
    double shift = 0.0;
    while (x < 12.0) {
        shift += log(x);
        x += 1.0;
    }
    constexpr double half_log_two_pi = 0.91893853320467274178;
    const double y = 1.0 / (x * x);
    const double series =
        (1.0 / 12 -
         y * (1.0 / 360 - y * (1.0 / 1260 - y * (1.0 / 1680 - y * (1.0 / 1188 - y * 691.0 / 360360))))) /
        x;
    return (x - 0.5) * log(x) - x + half_log_two_pi + series - shift;
}

double incomplete_beta(double a, double b, double x)
{
    if (!(x > 0.0)) return 0.0;
    if (x >= 1.0) return 1.0;
    const double front = exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * log(x) + b * log(1.0 - x));
    if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
    return 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

double normal_two_sided(double z)
{
    z = std::abs(z);
    constexpr double inverse_sqrt_2 = 0x1.6a09e667f3bcdp-1;
    if (z < 3.0) return 1.0 - erf(z * inverse_sqrt_2);
    // [2], 26.2.14, from the inside.
    double fraction = z;
    for (int k = 60; k > 0; --k) fraction = z + k / fraction;
    constexpr double two_over_sqrt_two_pi = 0.79788456080286535588;
    return two_over_sqrt_two_pi * exp(-0.5 * z * z) / fraction;
}

double student_two_sided(double t, double degrees_of_freedom)
{
    // The difference to the normal distribution is of the order of t^4 / degrees of freedom.
    if (degrees_of_freedom > 1e9) return normal_two_sided(t);
    const double t2 = t * t;
    if (t2 > 1e300) return 0.0;
    const double x = degrees_of_freedom / (degrees_of_freedom + t2);
    // Near t = 0, 1 - x would lose its digits: from the other side.
    if (t2 < 1e-3 * degrees_of_freedom && t2 < 1.0)
        return 1.0 - incomplete_beta(0.5, 0.5 * degrees_of_freedom, t2 / (degrees_of_freedom + t2));
    return incomplete_beta(0.5 * degrees_of_freedom, 0.5, x);
}

double student_quantile(double p, double degrees_of_freedom)
{
    double high = 1.0;
    while (student_two_sided(high, degrees_of_freedom) > p && high < 1e100) high *= 2.0;
    double low = 0.0;
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (student_two_sided(middle, degrees_of_freedom) > p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace plumb
