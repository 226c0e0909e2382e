// SPDX-License-Identifier: MIT

#include "plumb/render/stop_rules.h"
#include "support/catch.h"

using namespace plumb;

TEST_CASE("the noise is looked at after fixed numbers of samples", "[unit][stop_rules]")
{
    std::vector<std::uint64_t> looks;
    for (std::uint64_t samples = 0; samples < 320;)
        looks.push_back(samples = next_convergence_check(samples));
    CHECK(looks == std::vector<std::uint64_t>{16, 32, 48, 64, 80, 96, 112, 128, 160, 192, 224, 256, 320});

    // From wherever an interruption left it, the next look is one of them.
    std::uint64_t look = 0;
    for (std::uint64_t samples = 0; samples < 5000; ++samples) {
        if (samples == look) look = next_convergence_check(look);
        REQUIRE(next_convergence_check(samples) == look);
        REQUIRE(is_convergence_check(look));
        REQUIRE(is_convergence_check(samples) ==
                (samples > 0 && next_convergence_check(samples - 1) == samples));
    }
    // Waiting for a look costs at most a quarter.
    for (std::uint64_t samples = 64; samples < film_max_samples; samples = next_convergence_check(samples))
        REQUIRE(next_convergence_check(samples) <= samples + samples / 4);
}

TEST_CASE("how far a rendering goes next", "[unit][stop_rules]")
{
    StopRules rules;
    rules.samples_per_pixel = 100;
    CHECK(next_stop(rules, 0, 0.0) == 16);
    CHECK(next_stop(rules, 96, 5.0) == 100);
    CHECK(next_stop(rules, 100, 5.0) == 100);

    rules.seconds = 10.0;
    CHECK(next_stop(rules, 0, 0.0) == 1);   // always the first
    CHECK(next_stop(rules, 1, 0.1) == 16);  // time for 99 more, but there is a look before
    CHECK(next_stop(rules, 16, 8.0) == 20); // half a second each
    CHECK(next_stop(rules, 19, 9.9) == 19); // no time for another one
    CHECK(next_stop(rules, 1, 60.0) == 1);  // the first took longer than all
    CHECK(next_stop(rules, 5, 0.0) == 16);  // too fast to measure
    CHECK(next_stop(rules, 100, 1.0) == 100);
}

TEST_CASE("relative noise is noise over the mean", "[unit][stop_rules]")
{
    Film film({0, 0, 2, 1}, 2, 1);
    CHECK_FALSE(estimate_relative_noise(film));
    for (const float value : {1.f, 3.f}) film.add({0, 0}, Color(value), 1.f);
    CHECK_FALSE(estimate_relative_noise(film)); // the other pixel is not known
    for (const float value : {4.f, 4.f}) film.add({1, 0}, Color(value), 1.f);
    // The variances of the means are 1 and 0, the mean is 3.
    const auto noise = estimate_relative_noise(film);
    REQUIRE(noise);
    CHECK(noise->rmse == Approx(std::sqrt(0.5) / 3.0));
    CHECK(noise->low <= noise->rmse);
    CHECK(noise->high >= noise->rmse);

    Film black({0, 0, 1, 1}, 1, 1);
    for (int i = 0; i < 4; ++i) black.add({0, 0}, Color(0.f), 1.f);
    CHECK_FALSE(estimate_relative_noise(black));
}
