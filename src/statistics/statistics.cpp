// SPDX-License-Identifier: MIT

// [1] Abramowitz and Stegun 1964, Handbook of Mathematical Functions.
// [2] Lentz 1976, "Generating Bessel functions in Mie scattering calculations using continued fractions", Applied
//     Optics 15(3), with Thompson and Barnett's 1986 guard against zeros.
// [3] Goldberg 1991, "What Every Computer Scientist Should Know About Floating-Point Arithmetic", theorem 4.

#include "plumb/statistics/statistics.h"

#include "plumb/math/elementary.h"

namespace plumb {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// log(1 + x) without losing the digits of a small x [3].
double log_1p(double x)
{
    const double sum = 1.0 + x;
    return sum == 1.0 ? x : log(sum) * (x / (sum - 1.0));
}

// exp(x) - 1 likewise.
double exp_minus_1(double x)
{
    const double power = exp(x);
    if (power == 1.0) return x;
    const double difference = power - 1.0;
    return difference == -1.0 ? difference : difference * (x / log(power));
}

// A continued fraction b0 + a1 / (b1 + a2 / (b2 + ...)), term by term [2].
class ContinuedFraction {
public:
    explicit ContinuedFraction(double b0) : value_(away_from_zero(b0)), c_(value_) {}

    // Returns the factor by which this term changes the value.
    double add(double a, double b)
    {
        d_ = 1.0 / away_from_zero(b + a * d_);
        c_ = away_from_zero(b + a / c_);
        const double factor = c_ * d_;
        value_ *= factor;
        return factor;
    }

    double value() const { return value_; }

private:
    static double away_from_zero(double x) { return std::abs(x) < 1e-300 ? 1e-300 : x; }

    double value_;
    double c_;
    double d_ = 0.0;
};

constexpr double most_terms = 1e6; // none of the fractions below needs as many

// x^a e^-x / Gamma(a).
double gamma_front(double a, double x)
{
    return exp(a * log(x) - x - log_gamma(a));
}

// [1], 6.5.29: P as a series of positive terms; quick for x < a + 1.
double gamma_p_series(double a, double x)
{
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; term > sum * epsilon; n += 1.0) {
        term *= x / n;
        sum += term;
    }
    return sum * gamma_front(a, x);
}

// [1], 6.5.31, of which every other term is taken: Q for x >= a + 1.
double gamma_q_fraction(double a, double x)
{
    ContinuedFraction fraction(x + 1.0 - a);
    for (double i = 1.0; i < most_terms; i += 1.0)
        if (std::abs(fraction.add(-i * (i - a), x + 1.0 - a + 2.0 * i) - 1.0) < epsilon) break;
    return gamma_front(a, x) / fraction.value();
}

// [1], 26.5.8: quick for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x)
{
    ContinuedFraction fraction(1.0);
    for (double m = 0.0; m < most_terms; m += 1.0) {
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        const double n = m + 1.0;
        const double even = n * (b - n) * x / ((a + 2.0 * n - 1.0) * (a + 2.0 * n));
        const double change = fraction.add(odd, 1.0);
        if (std::abs(change * fraction.add(even, 1.0) - 1.0) < epsilon) break;
    }
    return 1.0 / fraction.value();
}

} // namespace

double log_gamma(double x)
{
    // [1], 6.1.15: Gamma(x) = Gamma(x + 1) / x, until the series below is good for all digits.
    double product = 1.0;
    for (; x < 12.0; x += 1.0) product *= x;
    // [1], 6.1.41.
    constexpr double half_log_two_pi = 0x1.d67f1c864beb5p-1;
    const double y = 1.0 / (x * x);
    const double series =
        (1.0 / 12 -
         y * (1.0 / 360 - y * (1.0 / 1260 - y * (1.0 / 1680 - y * (1.0 / 1188 - y * 691.0 / 360360))))) /
        x;
    return (x - 0.5) * log(x) - x + half_log_two_pi + series - log(product);
}

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

double regularised_beta(double a, double b, double x, double y)
{
    if (x <= 0.0) return 0.0;
    if (y <= 0.0) return 1.0;
    // The logarithm of the larger of x and y comes from the smaller one.
    const double log_x = x > 0.5 ? log_1p(-y) : log(x);
    const double log_y = y > 0.5 ? log_1p(-x) : log(y);
    const double front = exp(log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * log_x + b * log_y);
    if (x < (a + 1.0) / (a + b + 2.0)) return front * beta_fraction(a, b, x) / a;
    return 1.0 - front * beta_fraction(b, a, y) / b; // [1], 26.5.2
}

double chi2_survival(double statistic, double degrees_of_freedom)
{
    return regularised_gamma_q(degrees_of_freedom / 2.0, statistic / 2.0); // [1], 26.4.19
}

double normal_survival(double z)
{
    if (std::abs(z) == std::numeric_limits<double>::infinity()) return z < 0.0 ? 1.0 : 0.0;
    const double tail = 0.5 * regularised_gamma_q(0.5, z * z / 2.0); // [1], 26.2.29 and 6.5.17
    return z < 0.0 ? 1.0 - tail : tail;
}

double student_t_two_sided(double t, double degrees_of_freedom)
{
    // By then the two distributions agree to t^4 / 4e7, and the logarithms of the gamma functions would cancel.
    if (degrees_of_freedom > 1e7) return 2.0 * normal_survival(std::abs(t));
    if (std::abs(t) == std::numeric_limits<double>::infinity()) return 0.0;
    const double sum = degrees_of_freedom + t * t;
    return regularised_beta(degrees_of_freedom / 2.0, 0.5, degrees_of_freedom / sum,
                            t * t / sum); // [1], 26.7.1
}

double student_t_quantile(double p, double degrees_of_freedom)
{
    double high = 1.0;
    while (student_t_two_sided(high, degrees_of_freedom) > p && high < 1e100) high *= 2.0;
    double low = 0.0;
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (low + high);
        (student_t_two_sided(middle, degrees_of_freedom) > p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double sidak_level(double level, std::size_t tests)
{
    return -exp_minus_1(log_1p(-level) / static_cast<double>(tests));
}

} // namespace plumb
