// SPDX-License-Identifier: MIT

#include "plumb/sampling/distribution.h"

#include "support/catch.h"
#include "support/random.h"

#include <cmath>
#include <vector>

using namespace plumb;
using plumb::test::TestRandom;

namespace {

constexpr double below_one = 0x1.fffffffffffffp-1;

} // namespace

TEST_CASE("things are chosen in proportion to their weights", "[unit][distribution]")
{
    const DiscreteDistribution choice(std::vector<double>{1.0, 0.0, 3.0, 4.0});
    CHECK(choice.size() == 4);
    CHECK(choice.sum() == 8.0);
    CHECK(choice.probability(0) == 0.125f);
    CHECK(choice.probability(1) == 0.f);
    CHECK(choice.probability(2) == 0.375f);
    CHECK(choice.probability(3) == 0.5f);

    // Equally spaced numbers divide themselves exactly.
    std::vector<int> counts(4);
    for (int i = 0; i < 8000; ++i) ++counts[choice.sample((i + 0.5) / 8000.0).index];
    CHECK(counts == std::vector<int>{1000, 0, 3000, 4000});
}

TEST_CASE("what is left of the number is uniform again", "[unit][distribution]")
{
    const DiscreteDistribution choice(std::vector<double>{1.0, 3.0});
    CHECK(choice.sample(0.0).u == 0.0);
    CHECK(choice.sample(0.125).u == 0.5);
    CHECK(choice.sample(0.25).index == 1);
    CHECK(choice.sample(0.25).u == 0.0);
    CHECK(choice.sample(0.625).u == 0.5);
    CHECK(choice.sample(0.625).probability == 0.75f);
    TestRandom random;
    for (int i = 0; i < 10000; ++i) {
        const auto sample = choice.sample(random.next_double());
        CHECK(sample.u >= 0.0);
        CHECK(sample.u < 1.0);
    }
}

TEST_CASE("nothing of weight 0 is ever chosen", "[unit][distribution]")
{
    const std::vector<std::vector<double>> all_weights = {
        {0, 1, 0},         {0, 0, 1e-300, 0}, {0, 0.1, 0.2, 0.3, 0, 0},
        {1e300, 0, 1e300}, {0, 1e-300, 1, 0}, {0, 7, 0, 7, 0}};
    for (const auto& weights : all_weights) {
        const DiscreteDistribution choice(weights);
        REQUIRE(choice.can_sample());
        TestRandom random;
        for (int i = 0; i < 1000; ++i) {
            const double u = i == 0 ? 0.0 : i == 1 ? below_one : i == 2 ? 0.5 : random.next_double();
            const auto sample = choice.sample(u);
            CHECK(weights[sample.index] > 0.0);
            CHECK(sample.probability > 0.f);
            CHECK(sample.probability == choice.probability(sample.index));
            CHECK(sample.u < 1.0);
        }
        // On and beside every border.
        double border = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            border += static_cast<double>(choice.probability(i));
            for (const double u : {std::nextafter(border, 0.0), border, std::nextafter(border, 2.0)})
                if (u >= 0.0 && u < 1.0) CHECK(weights[choice.sample(u).index] > 0.0);
        }
    }
}

TEST_CASE("weights may be tiny, huge or both", "[unit][distribution]")
{
    const DiscreteDistribution mixed(std::vector<double>{1e-300, 1e300, 1e-300, 1e300});
    CHECK(mixed.probability(1) == 0.5f);
    CHECK(mixed.probability(3) == 0.5f);
    CHECK(mixed.sample(0.0).index == 1);
    CHECK(mixed.sample(below_one).index == 3);

    const DiscreteDistribution tiny(std::vector<double>{3e-300, 1e-300});
    CHECK(tiny.probability(0) == 0.75f);
    CHECK(tiny.sum() == Approx(4e-300));

    const DiscreteDistribution huge(std::vector<double>(10, 1e308)); // the plain sum is infinite
    CHECK(huge.can_sample());
    for (std::size_t i = 0; i < 10; ++i) CHECK(huge.probability(i) == Approx(0.1));
}

TEST_CASE("without a positive weight nothing can be chosen", "[unit][distribution]")
{
    CHECK_FALSE(DiscreteDistribution().can_sample());
    CHECK(DiscreteDistribution().size() == 0);
    CHECK_FALSE(DiscreteDistribution(std::vector<double>{}).can_sample());
    const DiscreteDistribution zeros(std::vector<double>{0.0, 0.0});
    CHECK_FALSE(zeros.can_sample());
    CHECK(zeros.size() == 2);
    CHECK(zeros.probability(1) == 0.f);
}

TEST_CASE("a million things keep their shares", "[unit][distribution]")
{
    std::vector<double> weights(1000000);
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<double>(i % 7);
    const DiscreteDistribution choice(weights);
    TestRandom random(9);
    for (int i = 0; i < 20000; ++i) {
        const double u = random.next_double();
        const auto sample = choice.sample(u);
        REQUIRE(weights[sample.index] > 0.0);
        CHECK(sample.probability == Approx(weights[sample.index] / choice.sum()).epsilon(1e-6));
        // Within a group of 7, of which 142857 fill the array, the place follows u.
        CHECK(std::abs(sample.index / 1e6 - u) < 1e-5);
    }
}
