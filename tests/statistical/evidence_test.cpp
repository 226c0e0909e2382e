// SPDX-License-Identifier: MIT

#include "plumb/render/evidence.h"
#include "support/catch.h"
#include "support/random.h"
#include "support/statistics.h"

#include <cmath>

using namespace plumb;
using namespace plumb::test;

namespace {

// What a pixel's samples are like: their mean and variance are known.
struct Distribution {
    std::string name;
    double mean;
    double variance;
    float (*draw)(TestRandom&);
};

const Distribution distributions[] = {
    {"uniform", 0.5, 1.0 / 12.0, [](TestRandom& random) { return random.next_1d(); }},
    {"exponential", 1.0, 1.0,
     [](TestRandom& random) { return static_cast<float>(-std::log1p(-double(random.next_1d()))); }},
    {"one path in four brings light", 1.0, 3.0,
     [](TestRandom& random) { return random.next_1d() < 0.25f ? 4.f : 0.f; }},
};

Film exposed(const Distribution& distribution, int side, int samples, TestRandom& random)
{
    Film film({0, 0, side, side}, side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (int i = 0; i < samples; ++i) film.add({x, y}, Color(distribution.draw(random)), 1.f);
    return film;
}

} // namespace

TEST_CASE("the variance of a pixel is estimated without bias", "[statistical][evidence]")
{
    const double level = sidak_level(significance, std::size(distributions) * 2);
    for (const Distribution& distribution : distributions) {
        for (const int samples : {2, 16}) {
            const auto estimate = [&](std::uint64_t pixels, std::uint64_t seed) {
                TestRandom random(seed);
                MeanAndVariance result;
                for (std::uint64_t i = 0; i < pixels; ++i)
                    result.add(static_cast<double>(
                        exposed(distribution, 1, samples, random).variance_of_mean({0, 0}).r));
                return result;
            };
            check_mean(distribution.name, distribution.variance / samples, estimate, 4000, level);
        }
    }
}

TEST_CASE("the noise of an image is estimated without bias, and its interval holds",
          "[statistical][evidence]")
{
    // Per image: the squared error that was estimated, and whether the truth is in the interval.
    const double level = sidak_level(significance, std::size(distributions) * 2);
    constexpr int side = 12;
    constexpr int samples = 16;
    for (const Distribution& distribution : distributions) {
        const double truth = distribution.variance / samples;
        const auto estimates = [&](std::uint64_t images, std::uint64_t seed, bool of_coverage) {
            TestRandom random(seed);
            MeanAndVariance result;
            for (std::uint64_t i = 0; i < images; ++i) {
                const auto noise = estimate_noise(exposed(distribution, side, samples, random));
                const bool covered = noise->low * noise->low <= truth && truth <= noise->high * noise->high;
                result.add(of_coverage ? (covered ? 1.0 : 0.0) : noise->rmse * noise->rmse);
            }
            return result;
        };
        check_mean(
            distribution.name, truth,
            [&](std::uint64_t n, std::uint64_t seed) { return estimates(n, seed, false); }, 300, level);
        // Of 144 pixels the interval's 95 % are 93 to 96 %.
        const MeanAndVariance coverage = estimates(1000, 3, true);
        CHECK(coverage.mean() > 0.92);
        CHECK(coverage.mean() < 0.98);
    }
}

TEST_CASE("the noise of an image of one sample is not known", "[statistical][evidence]")
{
    TestRandom random(1);
    CHECK_FALSE(estimate_noise(exposed(distributions[0], 2, 1, random)).has_value());
    CHECK(estimate_noise(exposed(distributions[0], 2, 2, random)).has_value());
}
