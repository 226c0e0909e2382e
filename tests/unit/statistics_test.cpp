// SPDX-License-Identifier: MIT

// The statistical tests themselves: known quantiles, and that they notice what they are for.

#include "support/catch.h"
#include "support/statistics.h"

#include <cmath>

using namespace plumb;
using namespace plumb::test;

TEST_CASE("survival functions agree with tables", "[unit][statistics]")
{
    // The tables' quantiles are rounded to the digits given here.
    CHECK(chi2_survival(3.841459, 1) == Approx(0.05).epsilon(1e-6));
    CHECK(chi2_survival(18.307038, 10) == Approx(0.05).epsilon(1e-6));
    CHECK(chi2_survival(135.806723, 100) == Approx(0.01).epsilon(1e-6));
    CHECK(student_t_two_sided(12.706205, 1) == Approx(0.05).epsilon(1e-6));
    CHECK(student_t_two_sided(2.228139, 10) == Approx(0.05).epsilon(1e-6));
    CHECK(student_t_two_sided(-3.169273, 10) == Approx(0.01).epsilon(1e-6));
    CHECK(normal_survival(1.644853627) == Approx(0.05).epsilon(1e-8));
}

TEST_CASE("survival functions agree with closed forms", "[unit][statistics]")
{
    for (const double x : {0.01, 0.5, 1.0, 3.0, 20.0, 80.0}) {
        CAPTURE(x);
        CHECK(chi2_survival(x, 2) == Approx(std::exp(-x / 2)).epsilon(1e-12));
        CHECK(regularised_gamma_p(0.5, x) == Approx(std::erf(std::sqrt(x))).epsilon(1e-12));
        CHECK(student_t_two_sided(x, 1) == Approx(1.0 - std::atan(x) * 2.0 / pi_d).epsilon(1e-10));
        CHECK(regularised_gamma_p(7.5, x) + regularised_gamma_q(7.5, x) == Approx(1.0).epsilon(1e-13));
    }
    for (const double t : {-2.0, 0.5, 3.0}) { // the normal distribution is the limit
        CHECK(student_t_two_sided(t, 1e6) == Approx(2.0 * normal_survival(std::abs(t))).epsilon(1e-4));
        CHECK(student_t_two_sided(t, 1e9) == Approx(2.0 * normal_survival(std::abs(t))).epsilon(1e-7));
    }
    CHECK(chi2_survival(0.0, 5) == 1.0);
    CHECK(student_t_two_sided(0.0, 5) == 1.0);
}

TEST_CASE("tests at the level of Sidak together fail at the level asked for", "[unit][statistics]")
{
    CHECK(sidak_level(0.01, 1) == Approx(0.01).epsilon(1e-14));
    CHECK(1.0 - std::pow(1.0 - sidak_level(0.01, 37), 37) == Approx(0.01).epsilon(1e-12));
}

TEST_CASE("the test of a mean accepts the right mean and rejects a wrong one", "[unit][statistics]")
{
    MeanAndVariance seen;
    TestRandom random(5);
    for (int i = 0; i < 100'000; ++i) seen.add(random.next_double());
    CHECK(mean_outcome(seen, 0.5).p > 0.01);
    CHECK(mean_outcome(seen, 0.505).p < 1e-4); // 5.5 standard errors
    CHECK(mean_outcome(seen, std::nan("")).p == 0.0);

    MeanAndVariance constant;
    for (int i = 0; i < 10; ++i) constant.add(2.0);
    CHECK(mean_outcome(constant, 2.0).p == 1.0);
    CHECK(mean_outcome(constant, 2.0001).p == 0.0);
}

namespace {

// Density 2 x on the unit square, which sampling u^(1/2) has, and of which `refused` of the samples are lost.
std::optional<Imath::V2d> sample_ramp(TestRandom& random, double refused)
{
    const double u = random.next_double();
    const double v = random.next_double();
    if (random.next_double() < refused) return std::nullopt;
    return Imath::V2d(std::sqrt(u), v);
}

double ramp_outcome(double refused, const PlaneDensity& density)
{
    const Grid grid{0, 1, 0, 1, 10, 10};
    const auto sample = [&](TestRandom& random) { return sample_ramp(random, refused); };
    return distribution_outcome(grid, sample, density, 100'000, 3).p;
}

} // namespace

TEST_CASE("the chi-square test accepts the right density and rejects wrong ones", "[unit][statistics]")
{
    CHECK(ramp_outcome(0.0, [](double x, double) { return 2 * x; }) > 0.01);
    CHECK(ramp_outcome(0.2, [](double x, double) { return 1.6 * x; }) > 0.01);

    CHECK(ramp_outcome(0.0, [](double, double) { return 1.0; }) < 1e-6);
    CHECK(ramp_outcome(0.0, [](double x, double y) { return 2 * x * (1.05 - 0.1 * y); }) < 1e-6);
    CHECK(ramp_outcome(0.0, [](double x, double) { return 1.96 * x; }) < 1e-6); // lacks 2 %
    CHECK(ramp_outcome(0.2, [](double x, double) { return 2 * x; }) < 1e-6);    // has 20 % too much
    CHECK(ramp_outcome(0.0, [](double x, double) { return 2.01 * x; }) == 0.0); // above 1
    CHECK(ramp_outcome(0.0, [](double x, double) { return x < 0.9 ? 2 / .81 * x : 0.; }) ==
          0.0); // 0 where samples are
}

TEST_CASE("quadrature copes with peaks and edges", "[unit][statistics]")
{
    const auto peak = [](double x, double y) { return std::exp(-(x * x + y * y) / 2e-4) / (2e-4 * pi_d); };
    double sum = 0.0;
    for (const double x : {-1.0, 0.0})
        for (const double y : {-1.0, 0.0}) sum += integrate(peak, x, x + 1, y, y + 1);
    CHECK(sum == Approx(1.0).epsilon(1e-6));
    CHECK(integrate([](double x, double y) { return x * x + y * y < 1 ? 1.0 : 0.0; }, 0, 1, 0, 1) ==
          Approx(pi_d / 4).epsilon(3e-5));

    const SphereGrid tilted{normalize(Vec3f(1, 2, -3)), 6.0, 20, 20};
    CHECK(integrate_sphere(tilted, [](const Vec3f&) { return 1.0; }) == Approx(4 * pi_d).epsilon(1e-6));
    CHECK(integrate_sphere(tilted, [](const Vec3f& w) { return std::max(0.f, w.z); }) ==
          Approx(pi_d).epsilon(1e-5));
}

TEST_CASE("test directions are uniform on the sphere", "[unit][statistics]")
{
    check_distribution(
        "TestRandom::direction", SphereGrid{}, [](TestRandom& random) { return random.direction(); },
        [](const Vec3f&) { return 1.0 / (4.0 * pi_d); }, 50'000, significance);
}
