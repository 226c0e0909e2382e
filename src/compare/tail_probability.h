// SPDX-License-Identifier: MIT
#pragma once

// Student's t and the normal distribution far out in their tails, with our own elementary functions.
//
// [1] Press, Teukolsky, Vetterling and Flannery 2007, Numerical Recipes, 3rd ed., sections 6.1 and 6.4
// [2] Abramowitz and Stegun 1964, Handbook of Mathematical Functions, 6.1.41, 26.2.14

namespace plumb {

double log_gamma(double x); // x > 0; relative error below 1e-12

// The regularised incomplete beta function I_x(a, b), a, b > 0.
double incomplete_beta(double a, double b, double x);

// The chance of a larger |t|. degrees_of_freedom > 0, also infinite.
double student_two_sided(double t, double degrees_of_freedom);
double normal_two_sided(double z);

// The t >= 0 that student_two_sided() gives p, 0 < p <= 1.
double student_quantile(double p, double degrees_of_freedom);

} // namespace plumb
