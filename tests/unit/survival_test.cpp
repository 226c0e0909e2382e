// SPDX-License-Identifier: MIT

// The program's survival functions: against closed forms, the values of another program, and those of the tests, which
// use libm.

#include "plumb/statistics/statistics.h"
#include "support/catch.h"
#include "support/statistics.h"

using plumb::pi_d;

TEST_CASE("the gamma functions agree with libm and closed forms", "[unit][survival]")
{
    for (double x = 0.01; x < 2e6; x *= 1.37) {
        CAPTURE(x);
        const double truth = std::lgamma(x);
        CHECK(std::abs(plumb::log_gamma(x) - truth) < 2e-14 * std::max(1.0, std::abs(truth)));
    }
    for (const double x : {0.001, 0.5, 1.0, 3.0, 7.0, 20.0, 80.0, 600.0}) {
        CAPTURE(x);
        CHECK(plumb::regularised_gamma_q(1.0, x) == Approx(std::exp(-x)).epsilon(1e-12).scale(0));
        CHECK(plumb::regularised_gamma_q(2.0, x) == Approx((1 + x) * std::exp(-x)).epsilon(1e-12).scale(0));
        CHECK(plumb::regularised_gamma_p(0.5, x) == Approx(std::erf(std::sqrt(x))).epsilon(1e-13));
        for (const double a : {0.5, 3.5, 50.0, 1e4})
            CHECK(plumb::regularised_gamma_p(a, x) + plumb::regularised_gamma_q(a, x) ==
                  Approx(1.0).epsilon(1e-14));
    }
}

TEST_CASE("the beta function agrees with closed forms", "[unit][survival]")
{
    for (const double x : {1e-9, 0.01, 0.3, 0.5, 0.77, 0.999}) {
        CAPTURE(x);
        CHECK(plumb::regularised_beta(1, 1, x, 1 - x) == Approx(x).epsilon(1e-13));
        CHECK(plumb::regularised_beta(3, 1, x, 1 - x) == Approx(x * x * x).epsilon(1e-13));
        CHECK(plumb::regularised_beta(1, 4, x, 1 - x) ==
              Approx(-std::expm1(4 * std::log1p(-x))).epsilon(1e-12).scale(0));
        CHECK(plumb::regularised_beta(0.5, 0.5, x, 1 - x) ==
              Approx(2 / pi_d * std::asin(std::sqrt(x))).epsilon(1e-12));
    }
    CHECK(plumb::regularised_beta(2, 3, 0, 1) == 0.0);
    CHECK(plumb::regularised_beta(2, 3, 1, 0) == 1.0);
    // What 1 - x has lost is in y.
    CHECK(1.0 - plumb::regularised_beta(1, 0.5, 1.0, 1e-20) == Approx(1e-10).epsilon(1e-5));
}

TEST_CASE("p-values agree with closed forms far into the tails", "[unit][survival]")
{
    for (const double x : {0.01, 0.5, 1.0, 3.0, 10.0, 30.0}) {
        CAPTURE(x);
        CHECK(plumb::chi2_survival(x, 2) == Approx(std::exp(-x / 2)).epsilon(1e-12).scale(0));
        CHECK(plumb::student_t_two_sided(x, 1) == Approx(std::atan(1 / x) * 2 / pi_d).epsilon(1e-12));
        CHECK(plumb::student_t_two_sided(-x, 2) ==
              Approx(2 / (2 + x * x + x * std::sqrt(2 + x * x))).epsilon(1e-11));
        CHECK(plumb::normal_survival(x) ==
              Approx(0.5 * std::erfc(x / std::sqrt(2.0))).epsilon(1e-11).scale(0));
        CHECK(plumb::normal_survival(-x) == Approx(1 - 0.5 * std::erfc(x / std::sqrt(2.0))).epsilon(1e-14));
    }
    CHECK(plumb::chi2_survival(0, 5) == 1.0);
    CHECK(plumb::student_t_two_sided(0, 5) == 1.0);
    CHECK(plumb::student_t_two_sided(INFINITY, 5) == 0.0);
    CHECK(plumb::normal_survival(0) == 0.5);
}

TEST_CASE("p-values agree with those of the tests", "[unit][survival]")
{
    for (const double dof : {1.0, 4.0, 19.0, 199.0, 1e4, 1e6}) {
        for (const double z : {-3.0, -1.0, 0.0, 0.3, 2.0, 5.0}) {
            CAPTURE(dof, z);
            const double statistic = std::max(0.1, dof + z * std::sqrt(2 * dof));
            CHECK(plumb::chi2_survival(statistic, dof) ==
                  Approx(plumb::test::chi2_survival(statistic, dof)).epsilon(1e-7).scale(0));
            CHECK(plumb::student_t_two_sided(z, dof) ==
                  Approx(plumb::test::student_t_two_sided(z, dof)).epsilon(1e-7).scale(0));
        }
    }
    // Where the normal distribution takes over there is no step.
    CHECK(plumb::student_t_two_sided(3, 9.99e6) ==
          Approx(plumb::student_t_two_sided(3, 1.001e7)).epsilon(1e-5));
}

TEST_CASE("levels after Sidak agree with libm", "[unit][survival]")
{
    for (const std::size_t tests : {1u, 2u, 15u, 1000u, 65536u})
        for (const double level : {1e-9, 0.01, 0.5, 0.99})
            CHECK(
                plumb::sidak_level(level, tests) ==
                Approx(-std::expm1(std::log1p(-level) / static_cast<double>(tests))).epsilon(1e-13).scale(0));
}

// The values are scipy 1.17's: 2 t.sf(t, n), 2 norm.sf(z), gammaln(x).
TEST_CASE("chances far out in the tails are right", "[unit][survival]")
{
    CHECK(plumb::student_t_two_sided(0.0, 5.0) == 1.0);
    CHECK(plumb::student_t_two_sided(0.5, 1.0) == Approx(0.7048327646991335).epsilon(1e-10));
    CHECK(plumb::student_t_two_sided(2.0, 3.5) == Approx(0.12613852257591343).epsilon(1e-10));
    CHECK(plumb::student_t_two_sided(-5.0, 16.0) == Approx(0.00013086769808078334).epsilon(1e-10));
    CHECK(plumb::student_t_two_sided(12.0, 16.0) == Approx(2.057463213604229e-09).epsilon(1e-9));
    CHECK(plumb::student_t_two_sided(8.0, 1e4) == Approx(1.3821208729065301e-15).epsilon(1e-7));
    CHECK(plumb::student_t_two_sided(40.0, 200.0) == Approx(2.2487396535202197e-97).epsilon(1e-8));
    CHECK(plumb::student_t_two_sided(1e-3, 50.0) == Approx(0.9992060947755017).epsilon(1e-12));
    CHECK(plumb::student_t_two_sided(8.0, 1e12) == Approx(1.244192114854348e-15).epsilon(1e-9));
    CHECK(plumb::student_t_two_sided(double(plumb::infinity), 3.0) == 0.0);

    CHECK(2.0 * plumb::normal_survival(0.5) == Approx(0.6170750774519738).epsilon(1e-10));
    CHECK(2.0 * plumb::normal_survival(2.9) == Approx(0.003731626600768075).epsilon(1e-8));
    CHECK(2.0 * plumb::normal_survival(3.1) == Approx(0.0019352064264367126).epsilon(1e-10));
    CHECK(2.0 * plumb::normal_survival(20.0) == Approx(5.507248237212311e-89).epsilon(1e-10));
    CHECK(2.0 * plumb::normal_survival(double(plumb::infinity)) == 0.0);

    CHECK(plumb::log_gamma(0.5) == Approx(0.5723649429247).epsilon(1e-12));
    CHECK(plumb::log_gamma(3.7) == Approx(1.428072326665388).epsilon(1e-12));
    CHECK(plumb::log_gamma(11.99) == Approx(17.477885575426185).epsilon(1e-12));
    CHECK(plumb::log_gamma(250.5) == Approx(1131.2840013322552).epsilon(1e-12));
}

TEST_CASE("quantiles undo the chances", "[unit][survival]")
{
    for (const double freedom : {0.7, 3.0, 16.0, 1e5, double(plumb::infinity)})
        for (const double p : {1.0, 0.5, 0.01, 1e-9})
            CHECK(plumb::student_t_two_sided(plumb::student_t_quantile(p, freedom), freedom) ==
                  Approx(p).epsilon(1e-6));
}
