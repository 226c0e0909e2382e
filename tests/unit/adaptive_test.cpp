// SPDX-License-Identifier: MIT

// How many samples a pixel gets, as a function of its pilot, the target and the maximum.

#include "plumb/render/adaptive.h"
#include "plumb/render/film.h"
#include "support/catch.h"
#include "support/random.h"

#include <algorithm>
#include <bit>

using namespace plumb;
using namespace plumb::test;

namespace {

// Values that are functions of a pixel and a number: each pixel has another share of light.
double pilot_value(std::uint64_t pixel, std::uint64_t number)
{
    TestRandom random(pixel * 7919 + number + 1);
    const double share = std::exp2(-static_cast<double>(pixel % 9));
    return random.next_double() < share ? random.next_double() / share : 0.0;
}

PixelPlan plan_of(std::uint64_t pixel, double target, std::uint64_t maximum)
{
    return plan_pixel(target, maximum, [&](std::uint64_t number) { return pilot_value(pixel, number); });
}

} // namespace

TEST_CASE("a pixel's number of samples does not depend on the maximum that it is cut at", "[unit][adaptive]")
{
    constexpr double target = 0.05;
    std::uint64_t numbers = 0; // as bits, which the pixels have
    for (std::uint64_t pixel = 0; pixel < 60; ++pixel) {
        const PixelPlan whole = plan_of(pixel, target, 1 << 16);
        CHECK(std::has_single_bit(whole.samples));
        numbers |= whole.samples;
        for (std::uint64_t maximum = 1; maximum <= 1 << 16; maximum = maximum * 3 / 2 + 1) {
            INFO("pixel " << pixel << ", maximum " << maximum);
            const PixelPlan plan = plan_of(pixel, target, maximum);
            CHECK(plan.reaches(maximum));
            CHECK(std::min(plan.samples, maximum) == std::min(whole.samples, maximum));
            CHECK((!plan.is_final || plan == whole));
        }
    }
    CHECK(std::popcount(numbers) >= 6); // or this has tested nothing
}

TEST_CASE("a pilot takes each of its samples once, and no more than it needs", "[unit][adaptive]")
{
    const auto taken = [](double target, std::uint64_t maximum) {
        std::uint64_t next = 0;
        plan_pixel(target, maximum, [&](std::uint64_t number) {
            CHECK(number == next++);
            return pilot_value(3, number);
        });
        return next;
    };
    CHECK(taken(1e-6, least_adaptive_samples) == 0); // nothing to decide
    CHECK(taken(1e3, 1 << 20) == first_pilot);
    CHECK(taken(1e-6, first_pilot * samples_per_pilot_sample) == first_pilot);
    CHECK(taken(1e-6, first_pilot * samples_per_pilot_sample + 1) == 2 * first_pilot);
    CHECK(taken(1e-6, 1 << 14) == (1 << 14) / samples_per_pilot_sample);
}

TEST_CASE("pixels without noise get the least number of samples, brighter noise gets more",
          "[unit][adaptive]")
{
    const auto samples = [](double value) {
        return plan_pixel(0.02, 1 << 16, [&](std::uint64_t) { return value; });
    };
    for (const double value : {0.0, 1e-30, 0.3, 1e9})
        CHECK(samples(value) == PixelPlan{least_adaptive_samples, true});
    // Scaling light far above the floor changes nothing; far below it, less light is less noise.
    const auto scaled = [](double scale) {
        return plan_pixel(0.01, 1 << 20, [&](std::uint64_t i) { return scale * pilot_value(4, i); }).samples;
    };
    CHECK(scaled(64.0) == scaled(64.0 * 64.0));
    CHECK(scaled(1e-6) == least_adaptive_samples);
    CHECK(scaled(64.0) > scaled(1e-6));
}

TEST_CASE("a plan survives as a word, and one that knows more of a pixel is larger", "[unit][adaptive]")
{
    for (std::uint64_t samples = least_adaptive_samples; samples <= film_max_samples; samples *= 2) {
        for (const bool is_final : {false, true})
            CHECK(PixelPlan::from_word(PixelPlan{samples, is_final}.word()) == PixelPlan{samples, is_final});
        CHECK(PixelPlan{samples, true}.word() > PixelPlan{samples, false}.word());
        CHECK(PixelPlan{2 * samples, false}.word() > PixelPlan{samples, true}.word());
    }
    CHECK(PixelPlan::from_word(0) == PixelPlan{});
    CHECK_FALSE(PixelPlan{}.reaches(1));
    CHECK(PixelPlan{16, true}.reaches(1000));
    CHECK(PixelPlan{256, false}.reaches(256));
    CHECK_FALSE(PixelPlan{256, false}.reaches(257));
}
