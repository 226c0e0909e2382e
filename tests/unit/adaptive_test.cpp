// SPDX-License-Identifier: MIT

// How many samples a pixel gets, as a function of its pilot and the target.

#include "plumb/render/adaptive.h"
#include "plumb/render/film.h"
#include "support/catch.h"

#include <algorithm>
#include <vector>

using namespace plumb;

namespace {

// Of mean 1 and with this deviation: half of the samples are brighter, half are darker; up to 1.
std::vector<double> even(std::uint64_t size, double deviation)
{
    std::vector<double> values(size, 1.0 - deviation);
    std::fill_n(values.begin(), size / 2, 1.0 + deviation);
    return values;
}

// Of mean 1 and with a deviation of 2 (1 - 1 / size): one sample is bright, the others are black.
std::vector<double> rare(std::uint64_t size)
{
    std::vector<double> values(size, 0.0);
    values[size / 3] = static_cast<double>(size);
    return values;
}

} // namespace

TEST_CASE("the target settles the usual number of samples, and the sizes that follow", "[unit][adaptive]")
{
    struct Sizes {
        double target;
        std::uint64_t usual, least, pilot;
    };
    for (const Sizes& sizes : {Sizes{1.0, 16, 16, 16}, Sizes{0.25, 16, 16, 16}, Sizes{0.125, 64, 32, 16},
                               Sizes{0.03125, 1024, 512, 32}, Sizes{0.03, 1024, 512, 32},
                               Sizes{0.02, 2048, 1024, 64}, Sizes{1e-4, 1 << 26, 1 << 25, 1 << 21}}) {
        INFO(sizes.target);
        const AdaptiveRule rule(sizes.target);
        CHECK(rule.usual() == sizes.usual);
        CHECK(rule.least() == sizes.least);
        CHECK(rule.pilot_size() == sizes.pilot);
    }
}

TEST_CASE("a pixel's number of samples grows with the power 2/3 of its deviation", "[unit][adaptive]")
{
    const AdaptiveRule rule(1.0 / 64.0); // 4096 samples, a pilot of 128
    CHECK(rule.samples(even(128, 1.0)) == 4096);
    // 2^(-3/4) is where 4096 and 2048 meet.
    CHECK(rule.samples(even(128, 0.596)) == 4096);
    CHECK(rule.samples(even(128, 0.594)) == 2048);
    CHECK(rule.samples(even(128, 0.01)) == rule.least());
    CHECK(rule.samples(even(128, 0.0)) == rule.least());
    // A deviation of nearly 2; and of 1/8 of that where the floor is 8 times the mean.
    CHECK(rule.samples(rare(128)) == 8192);
    std::vector<double> dark = rare(128);
    for (double& value : dark) value *= adaptive_floor / 8.0;
    CHECK(rule.samples(dark) == rule.least());
    // Far above the floor it is relative to the pixel.
    std::vector<double> bright = even(128, 0.7);
    const std::uint64_t samples = rule.samples(bright);
    for (double& value : bright) value *= 1e6;
    CHECK(rule.samples(bright) == samples);
    // No pilot asks for more than a film holds.
    CHECK(AdaptiveRule(1e-4).samples(rare(1 << 21)) == film_max_samples);
}
