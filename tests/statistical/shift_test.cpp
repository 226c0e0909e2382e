// SPDX-License-Identifier: MIT

// Images of edges, gradients and noise: those in their place are not said to be shifted, and those that are shifted by
// half a pixel are.

#include "plumb/compare/compare.h"
#include "support/catch.h"
#include "support/noisy_image.h"
#include "support/statistics.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr int width = 128;
constexpr int height = 96;

// Radiance at a point of the film, in pixels: a room with a lamp, a wall, a ball and brightness that falls off.
double radiance(double x, double y)
{
    const double falloff = 0.1 + 400.0 / (400.0 + sqr(x - 60.0) + 2.0 * sqr(y - 5.0));
    if (x > 44.3 && x < 79.8 && y < 3.4) return 10.0;
    if (x > 105.0 + 0.1 * y) return 0.4 * falloff;
    if (sqr(x - 40.2) + sqr(y - 60.7) < sqr(18.0)) return 0.05 + 0.5 * falloff * (x - 20.0) / 40.0;
    return falloff;
}

// Each pixel is the mean of independent samples of 16 points, right of where they belong by this many pixels.
Image image_of_a_room(double shift, const SampleKind& kind, int samples, std::uint64_t seed)
{
    Image image({0, 0, width, height}, width, height, {"Y"});
    TestRandom random(seed);
    constexpr int side = 4;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double sum = 0.0;
            for (int i = 0; i < side * side; ++i)
                sum += radiance(x + (i % side + 0.5) / side - shift, y + (i / side + 0.5) / side) *
                       kind.draw(samples / (side * side), random).sum;
            *image.pixel(x, y) = static_cast<float>(sum / samples);
        }
    }
    return image;
}

Comparison compare_rooms(double shift, const SampleKind& kind, std::uint64_t seed)
{
    CompareSettings options;
    options.flip = FlipMode::none;
    return compare(image_of_a_room(shift, kind, 64, 2 * seed), image_of_a_room(0.0, kind, 256, 2 * seed + 1),
                   options);
}

} // namespace

TEST_CASE("an image in its place is not said to be shifted", "[statistical][compare]")
{
    const std::vector<SampleKind> kinds = {normal_samples(0.02), normal_samples(0.3), exponential_samples(),
                                           lognormal_samples(1.0), hits(0.1)};
    for (const SampleKind& kind : kinds) {
        const auto run = [&](std::uint64_t pairs, std::uint64_t seed) {
            std::uint64_t alarms = 0;
            for (std::uint64_t i = 0; i < pairs; ++i)
                if (compare_rooms(0.0, kind, seed * 1000003 + i).significance.verdict == Verdict::differs)
                    ++alarms;
            return test::Outcome{binomial_survival(alarms, pairs, CompareSettings().significance),
                                 fmt::format("{} of {} pairs differ", alarms, pairs)};
        };
        check_statistic(kind.name, run, 20, sidak_level(significance, kinds.size()));
    }
}

TEST_CASE("an image half a pixel off is said to be so", "[statistical][compare]")
{
    for (const SampleKind& kind : {normal_samples(0.3), exponential_samples(), lognormal_samples(1.0)}) {
        int found = 0;
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const Comparison comparison = compare_rooms(0.5, kind, seed);
            if (comparison.significance.verdict == Verdict::differs) ++found;
        }
        INFO(kind.name << ": " << found << " of 10");
        CHECK(found >= 9);
    }
}
