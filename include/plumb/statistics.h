// SPDX-License-Identifier: MIT
#pragma once

// The distributions that statistical tests ask about. In double precision, with the same bits on every machine.
//
// A survival function is the chance of a value larger than the one given: the p-value of a test.

#include "plumb/math.h"

namespace plumb {

double log_gamma(double x); // x > 0

// The regularised incomplete gamma functions, a > 0 and x >= 0: P and Q = 1 - P.
double regularised_gamma_p(double a, double x);
double regularised_gamma_q(double a, double x);

// The regularised incomplete beta function I_x(a, b), a > 0 and b > 0, where y = 1 - x: given by its own, y keeps
// the digits that 1 - x would lose.
double regularised_beta(double a, double b, double x, double y);

double chi2_survival(double statistic, double degrees_of_freedom);
double normal_survival(double z);
double student_t_two_sided(double t, double degrees_of_freedom); // chance of a larger |t|
double student_t_quantile(double p, double degrees_of_freedom);  // the t >= 0 of which that is p; 0 < p <= 1

// The level of each of `tests` independent tests that together fail by chance with probability `level` (Sidak 1967).
double sidak_level(double level, std::size_t tests);

// Mean and variance of a stream of numbers (Welford 1962), and of two streams together (Chan, Golub and LeVeque 1983).
class MeanAndVariance {
public:
    void add(double x)
    {
        ++count_;
        const double delta = x - mean_;
        mean_ += delta / static_cast<double>(count_);
        sum_of_squares_ += delta * (x - mean_);
    }

    void add(const MeanAndVariance& other)
    {
        if (other.count_ == 0) return;
        const auto both = static_cast<double>(count_ + other.count_);
        const double share = static_cast<double>(other.count_) / both;
        const double delta = other.mean_ - mean_;
        sum_of_squares_ += other.sum_of_squares_ + delta * delta * share * static_cast<double>(count_);
        mean_ += delta * share;
        count_ += other.count_;
    }

    std::uint64_t count() const { return count_; }
    double mean() const { return mean_; }
    double variance() const { return count_ > 1 ? sum_of_squares_ / static_cast<double>(count_ - 1) : 0.0; }

private:
    std::uint64_t count_ = 0;
    double mean_ = 0.0;
    double sum_of_squares_ = 0.0; // of the distances from the mean
};

} // namespace plumb
