// SPDX-License-Identifier: MIT
#pragma once

// The distributions that statistical tests ask about. In double precision, with the same bits on every machine.
//
// A survival function is the chance of a value larger than the one given: the p-value of a test.

#include "plumb/math/math.h"

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

// The normal distribution has 95 % between this and its opposite.
inline constexpr double normal_quantile_95 = 1.959963984540054;

// The level of each of `tests` independent tests that together fail by chance with probability `level` (Sidak 1967).
double sidak_level(double level, std::size_t tests);

} // namespace plumb
