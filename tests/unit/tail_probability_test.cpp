// SPDX-License-Identifier: MIT
#include "plumb/statistics.h"
#include "support/catch.h"

using namespace plumb;

// The values are scipy 1.17's: 2 t.sf(t, n), 2 norm.sf(z), gammaln(x).
TEST_CASE("chances far out in the tails are right", "[unit][statistics]")
{
    CHECK(student_t_two_sided(0.0, 5.0) == 1.0);
    CHECK(student_t_two_sided(0.5, 1.0) == Approx(0.7048327646991335).epsilon(1e-10));
    CHECK(student_t_two_sided(2.0, 3.5) == Approx(0.12613852257591343).epsilon(1e-10));
    CHECK(student_t_two_sided(-5.0, 16.0) == Approx(0.00013086769808078334).epsilon(1e-10));
    CHECK(student_t_two_sided(12.0, 16.0) == Approx(2.057463213604229e-09).epsilon(1e-9));
    CHECK(student_t_two_sided(8.0, 1e4) == Approx(1.3821208729065301e-15).epsilon(1e-7));
    CHECK(student_t_two_sided(40.0, 200.0) == Approx(2.2487396535202197e-97).epsilon(1e-8));
    CHECK(student_t_two_sided(1e-3, 50.0) == Approx(0.9992060947755017).epsilon(1e-12));
    CHECK(student_t_two_sided(8.0, 1e12) == Approx(1.244192114854348e-15).epsilon(1e-9));
    CHECK(student_t_two_sided(double(infinity), 3.0) == 0.0);

    CHECK(2.0 * normal_survival(0.5) == Approx(0.6170750774519738).epsilon(1e-10));
    CHECK(2.0 * normal_survival(2.9) == Approx(0.003731626600768075).epsilon(1e-8));
    CHECK(2.0 * normal_survival(3.1) == Approx(0.0019352064264367126).epsilon(1e-10));
    CHECK(2.0 * normal_survival(20.0) == Approx(5.507248237212311e-89).epsilon(1e-10));
    CHECK(2.0 * normal_survival(double(infinity)) == 0.0);

    CHECK(log_gamma(0.5) == Approx(0.5723649429247).epsilon(1e-12));
    CHECK(log_gamma(3.7) == Approx(1.428072326665388).epsilon(1e-12));
    CHECK(log_gamma(11.99) == Approx(17.477885575426185).epsilon(1e-12));
    CHECK(log_gamma(250.5) == Approx(1131.2840013322552).epsilon(1e-12));
}

TEST_CASE("quantiles undo the chances", "[unit][statistics]")
{
    for (const double freedom : {0.7, 3.0, 16.0, 1e5, double(infinity)})
        for (const double p : {1.0, 0.5, 0.01, 1e-9})
            CHECK(student_t_two_sided(student_t_quantile(p, freedom), freedom) == Approx(p).epsilon(1e-6));
}
