// SPDX-License-Identifier: MIT

#include "plumb/statistics/mean_and_variance.h"
#include "support/catch.h"
#include "support/random.h"

using namespace plumb;

TEST_CASE("mean and variance of known numbers", "[unit][statistics]")
{
    MeanAndVariance seen;
    for (const double x : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) seen.add(x + 1e6);
    CHECK(seen.count() == 8);
    CHECK(seen.mean() == 1e6 + 5.0);
    CHECK(seen.variance() == Approx(32.0 / 7.0).epsilon(1e-9));
    CHECK(seen.standard_error() == Approx(std::sqrt(4.0 / 7.0)).epsilon(1e-9));
}

TEST_CASE("means of parts are those of the whole", "[unit][statistics]")
{
    test::TestRandom random(3);
    MeanAndVariance whole, together;
    for (const int size : {1, 0, 1000, 7}) {
        MeanAndVariance part;
        for (int i = 0; i < size; ++i) {
            const double x = 1e4 + random.next_double();
            part.add(x);
            whole.add(x);
        }
        together.add(part);
    }
    CHECK(together.count() == 1008);
    CHECK(together.mean() == Approx(whole.mean()).epsilon(1e-14));
    CHECK(together.variance() == Approx(whole.variance()).epsilon(1e-9));
    CHECK(MeanAndVariance().variance() == 0.0);
}
