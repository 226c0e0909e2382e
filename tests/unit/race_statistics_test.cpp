// SPDX-License-Identifier: MIT

#include "plumb/experiments/race.h"

#include "plumb/statistics/mean_and_variance.h"
#include "plumb/statistics/statistics.h"
#include "support/catch.h"
#include "support/random.h"

using namespace plumb;

namespace {

using Values = std::vector<double>;

Rounds rounds_of(const std::vector<double>& seconds, const std::vector<Values>& images)
{
    Values mean(images[0].size(), 0.0);
    for (const Values& image : images)
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i] += image[i] / static_cast<double>(images.size());
    Rounds rounds{seconds, {}};
    for (const Values& image : images) {
        MeanAndVariance squares;
        for (std::size_t i = 0; i < mean.size(); ++i) squares.add(sqr(image[i] - mean[i]));
        rounds.deviations.push_back(squares.mean());
    }
    return rounds;
}

// Time times variance of the rounds but one.
double cost_without(const std::vector<double>& seconds, const Values& values, std::size_t left_out)
{
    MeanAndVariance time, value;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i == left_out) continue;
        time.add(seconds[i]);
        value.add(values[i]);
    }
    return time.mean() * value.variance();
}

} // namespace

TEST_CASE("the efficiency and its interval are those of the jackknife, round by round", "[unit][race]")
{
    const std::vector<double> seconds_a = {1.0, 1.5, 1.25, 3.0, 1.0}, seconds_b = {2.0, 2.5, 2.0, 4.0, 2.25};
    const Values a = {1.0, 2.0, 4.0, 8.0, 16.0}, b = {0.0, 3.0, 1.0, 5.0, 2.0}; // one pixel, five rounds
    const Rounds rounds_a = rounds_of(seconds_a, {{1.0}, {2.0}, {4.0}, {8.0}, {16.0}});
    const Rounds rounds_b = rounds_of(seconds_b, {{0.0}, {3.0}, {1.0}, {5.0}, {2.0}});
    CHECK(rounds_a.mean_seconds() == Approx(1.55));
    CHECK(rounds_a.variance() == Approx(37.2)); // (341 - 31^2 / 5) / 4

    MeanAndVariance logs;
    for (std::size_t i = 0; i < 5; ++i)
        logs.add(std::log(cost_without(seconds_b, b, i) / cost_without(seconds_a, a, i)));
    const double ratio = cost_without(seconds_b, b, 5) / cost_without(seconds_a, a, 5); // none left out
    const double half = student_t_quantile(0.05, 4.0) * std::sqrt(logs.variance() * 16.0 / 5.0);
    const auto found = efficiency_ratio(rounds_a, rounds_b);
    REQUIRE(found);
    CHECK(found->value == Approx(ratio).epsilon(1e-9));
    CHECK(found->low == Approx(ratio * std::exp(-half)).epsilon(1e-9));
    CHECK(found->high == Approx(ratio * std::exp(half)).epsilon(1e-9));
}

TEST_CASE("95 of 100 intervals hold the efficiency", "[unit][race]")
{
    constexpr int trials = 1000, pixels = 40, count = 16;
    test::TestRandom random(5);
    int held = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> seconds[2];
        std::vector<Values> images[2];
        for (int round = 0; round < count; ++round) {
            const double load = random.between(1.0, 2.0); // of the machine, in that round
            for (int i = 0; i < 2; ++i) {
                seconds[i].push_back(load * random.between(0.9, 1.1));
                Values image;
                for (int pixel = 0; pixel < pixels; ++pixel)
                    image.push_back((1.0 + i) * random.between(-1.0, 1.0));
                images[i].push_back(image);
            }
        }
        const auto found =
            efficiency_ratio(rounds_of(seconds[0], images[0]), rounds_of(seconds[1], images[1]));
        REQUIRE(found);
        held += found->low <= 4.0 && found->high >= 4.0; // half the spread, in the same time
    }
    CHECK(held >= 930);
    CHECK(held <= 970);
}

TEST_CASE("images without noise have no efficiency", "[unit][race]")
{
    const Rounds noisy{{1.0, 1.0, 1.0}, {0.5, 0.25, 0.125}}, exact{{1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}};
    CHECK_FALSE(efficiency_ratio(noisy, exact));
    CHECK_FALSE(efficiency_ratio(exact, noisy));
    CHECK(efficiency_ratio(noisy, noisy)->value == 1.0);
}

TEST_CASE("the error of noise is the root of the variance, that of images against a reference of the mean",
          "[unit][race]")
{
    const Rounds rounds = rounds_of({1.0, 1.0, 1.0, 1.0, 1.0}, {{1.0}, {2.0}, {4.0}, {8.0}, {16.0}});
    const auto spread = rmse_of_spread(rounds);
    REQUIRE(spread);
    CHECK(spread->value == Approx(std::sqrt(37.2)));
    CHECK(spread->low < spread->value);
    CHECK(spread->high > spread->value);
    CHECK_FALSE(rmse_of_spread(rounds_of({1.0, 1.0, 1.0}, {{2.0}, {2.0}, {2.0}})));

    const auto error = rmse_of_errors({1.0, 2.0, 3.0, 2.0});
    REQUIRE(error);
    CHECK(error->value == Approx(std::sqrt(2.0)));
    // The jackknife of a mean is its standard error; of half its logarithm, that over twice the mean.
    const double half = std::log(error->high / error->value);
    CHECK(half ==
          Approx(student_t_quantile(0.05, 3.0) * std::sqrt(2.0 / 3.0 / 4.0) / (2.0 * 2.0)).epsilon(0.05));
    CHECK(std::log(error->value / error->low) == Approx(half));
    CHECK_FALSE(rmse_of_errors({1.0, -1.0, -2.0})); // below the noise of the reference
}

TEST_CASE("the interval of an error covers it in 19 of 20 races", "[unit][race]")
{
    test::TestRandom random(17);
    const auto normal = [&] {
        const double u = 1.0 - random.next_double();
        return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * pi_d * random.next_double());
    };
    int covered = 0;
    constexpr int races = 400;
    for (int race = 0; race < races; ++race) {
        std::vector<Values> images(12, Values(20));
        for (Values& image : images)
            for (double& value : image) value = 3.0 + 0.5 * normal();
        const auto error = rmse_of_spread(rounds_of(std::vector<double>(12, 1.0), images));
        REQUIRE(error);
        covered += error->low < 0.5 && 0.5 < error->high ? 1 : 0;
    }
    CHECK(covered > 360); // 380 expected, with a deviation of 4.4
    CHECK(covered < 397);
}
