// SPDX-License-Identifier: MIT
#pragma once

// Statistical tests: survival functions, and the policy by which tests pass or fail.
//
// Conventions. A level is the chance that a test fails although all is right: 0.01 for a whole family of tests,
// shared out by sidak_level(). Seeds are fixed, so a test always gives the same answer. A test that fails is
// repeated once with 100 times the samples and another seed, and that result counts. Everything is in double
// precision and uses the C library's functions, not the ones under test.

#include "plumb/statistics/mean_and_variance.h"
#include "support/random.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace plumb::test {

inline constexpr double significance = 0.01;

// The regularised incomplete gamma functions, a > 0 and x >= 0: P and Q = 1 - P (Press et al., "Numerical
// Recipes", section 6.2).
double regularised_gamma_p(double a, double x);
double regularised_gamma_q(double a, double x);

double chi2_survival(double statistic, double degrees_of_freedom); // chance of a larger statistic
double normal_survival(double z);                                  // chance of a larger z, one-sided
// Chance of `count` or more successes in so many trials.
double binomial_survival(std::uint64_t count, std::uint64_t trials, double chance);
double student_t_two_sided(double t, double degrees_of_freedom); // chance of a larger |t|

// The level of each of `tests` tests that together fail by chance with probability `level`.
double sidak_level(double level, std::size_t tests);

// The outcome of one run: its p-value, and a line that says what was seen.
struct Outcome {
    double p = 0.0;
    std::string text;
};

// The policy. Runs `run(samples, seed)`; if its p-value is below the level, runs it again with 100 times the samples
// and another seed. Adds a Catch2 assertion about the result that counts. Returns whether it passed.
bool check_statistic(const std::string& name, const std::function<Outcome(std::uint64_t, std::uint64_t)>& run,
                     std::uint64_t samples, double level, std::uint64_t seed = 1);

// The mean of what estimate(samples, seed) gathers is `expected`, by Student's t test. A difference of
// `relative_rounding` of the expected value is free: float arithmetic has a bias of its own.
using Estimate = std::function<MeanAndVariance(std::uint64_t samples, std::uint64_t seed)>;
Outcome mean_outcome(const MeanAndVariance& estimate, double expected, double relative_rounding = 1e-6);
bool check_mean(const std::string& name, double expected, const Estimate& estimate, std::uint64_t samples,
                double level, std::uint64_t seed = 1, double relative_rounding = 1e-6);

// Two estimates have the same mean, by Welch's t test.
Outcome same_mean_outcome(const MeanAndVariance& a, const MeanAndVariance& b,
                          double relative_rounding = 1e-6);

// The same by the policy. The second estimate gets another seed; what rounding may do to renderings is free.
bool check_same_mean(const std::string& name, const Estimate& a, const Estimate& b, std::uint64_t samples,
                     double level, std::uint64_t seed = 1);

// A rectangle of the plane cut into columns x rows cells.
struct Grid {
    double x_min = 0.0, x_max = 1.0;
    double y_min = 0.0, y_max = 1.0;
    int columns = 16;
    int rows = 16;
};

// A sampling routine on a grid, and its density per unit area of the grid's plane. A sample of nothing is one that
// the routine refuses; its chance is what the density lacks to 1.
using PlaneSampler = std::function<std::optional<Imath::V2d>(TestRandom&)>;
using PlaneDensity = std::function<double(double x, double y)>;

// The integral of `density` over [x0, x1] x [y0, y1], adaptively, to about `tolerance`.
double integrate(const PlaneDensity& density, double x0, double x1, double y0, double y1,
                 double tolerance = 1e-8);

// Pearson's chi-square test of a sampling routine against its density. The density is integrated over each cell;
// cells that expect fewer than 5 samples are pooled; a sample where nothing is expected, or off the grid, fails, and
// so does a density whose integral is above 1.
Outcome distribution_outcome(const Grid& grid, const PlaneSampler& sample, const PlaneDensity& density,
                             std::uint64_t samples, std::uint64_t seed);
bool check_distribution(const std::string& name, const Grid& grid, const PlaneSampler& sample,
                        const PlaneDensity& density, std::uint64_t samples, double level,
                        std::uint64_t seed = 1);

// The same over the sphere. Cells are those of (s, phi) about `axis`, where s in [0, 1] and
// cos(theta) = 1 - 2 s^concentration: with 1 all cells have the same solid angle, larger values make cells near the
// axis finer. The density is per unit solid angle.
struct SphereGrid {
    Vec3f axis{0.f, 0.f, 1.f};
    double concentration = 1.0;
    int cos_theta_cells = 20; // even: the equator of the axis is a border
    int phi_cells = 20;
};
using DirectionSampler = std::function<std::optional<Vec3f>(TestRandom&)>;
using DirectionDensity = std::function<double(const Vec3f&)>;
Outcome distribution_outcome(const SphereGrid& grid, const DirectionSampler& sample,
                             const DirectionDensity& density, std::uint64_t samples, std::uint64_t seed);
bool check_distribution(const std::string& name, const SphereGrid& grid, const DirectionSampler& sample,
                        const DirectionDensity& density, std::uint64_t samples, double level,
                        std::uint64_t seed = 1);

// The integral of `value` over the sphere with the cells of a grid, adaptively.
double integrate_sphere(const SphereGrid& grid, const std::function<double(const Vec3f&)>& value,
                        double tolerance = 1e-7);

} // namespace plumb::test
