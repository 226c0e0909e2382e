// SPDX-License-Identifier: MIT

// How often `compare` finds a difference where there is none, and how often it finds one that there is.

#include "plumb/compare/compare.h"
#include "support/catch.h"
#include "support/noisy_image.h"
#include "support/statistics.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// The other image of a pair.
enum class Other { same_samples, more_samples, exact, smooth };

constexpr Other all_others[] = {Other::same_samples, Other::more_samples, Other::exact, Other::smooth};

std::string_view name_of(Other other)
{
    switch (other) {
    case Other::same_samples: return "as many samples";
    case Other::more_samples: return "16 times the samples";
    case Other::exact: return "the truth";
    case Other::smooth: return "another estimator";
    }
    return "";
}

Comparison compare_pair(const NoisyImage& how, const SampleKind& kind, Other other, std::uint64_t seed)
{
    NoisyImage how_a = how;
    how_a.estimator = "path";
    NoisyImage how_b = how_a;
    how_b.bias = 1.0;
    if (other == Other::more_samples) how_b.samples *= 16;
    if (other == Other::smooth) {
        how_b.samples = 64;
        how_b.estimator = "smooth";
    }
    CompareSettings options;
    options.flip = FlipMode::none;
    if (other == Other::exact) options.exact = Side::b;
    const Image a = noisy_image(how_a, kind, 2 * seed);
    return compare(
        a,
        other == Other::exact
            ? true_image(how)
            : noisy_image(how_b, other == Other::smooth ? normal_samples(0.1) : kind, 2 * seed + 1),
        options);
}

void check_false_alarms(const NoisyImage& how, const SampleKind& kind, Other other, std::uint64_t trials,
                        double level)
{
    const auto run = [&](std::uint64_t pairs, std::uint64_t seed) {
        std::uint64_t alarms = 0;
        for (std::uint64_t i = 0; i < pairs; ++i)
            if (compare_pair(how, kind, other, seed * 1000003 + i).significance.verdict == Verdict::differs)
                ++alarms;
        return test::Outcome{binomial_survival(alarms, pairs, CompareSettings().significance),
                             fmt::format("{} of {} pairs differ", alarms, pairs)};
    };
    check_statistic(fmt::format("{}, {} samples, contrast {}, against {}", kind.name, how.samples,
                                how.contrast, name_of(other)),
                    run, trials, level);
}

} // namespace

TEST_CASE("compare keeps its error rate, in short", "[statistical][compare]")
{
    const std::vector<SampleKind> kinds = {normal_samples(0.3), exponential_samples(), hits(0.1), hits(1e-2)};
    const double level = sidak_level(significance, 4 * kinds.size());
    for (const SampleKind& kind : kinds)
        for (const Other other : all_others) {
            NoisyImage how;
            how.contrast = other == Other::exact ? 100.0 : 1.0;
            check_false_alarms(how, kind, other, other == Other::more_samples ? 20 : 120, level);
        }
}

// Both images, or the one of few samples, have missed the rare light in many squares of 16x16 pixels: `number` is how
// many rare samples they expect of one.
TEST_CASE("compare keeps its error rate where rare bright samples add to ordinary light",
          "[statistical][compare]")
{
    const std::vector<double> numbers = {0.6, 2.0, 5.0};
    const double level = sidak_level(significance, 4 * numbers.size());
    for (const double number : numbers)
        for (const Other other : all_others) {
            NoisyImage how;
            how.size = 64;
            how.samples = 16;
            check_false_alarms(how, rare_light(0.3, number / (256.0 * how.samples)), other, 20, level);
        }
}

TEST_CASE("compare keeps its error rate", "[statistical][compare][slow]")
{
    struct Case {
        SampleKind kind;
        int size;
        int samples;
        std::uint64_t trials;
    };
    std::vector<Case> cases;
    for (const double chance : {1e-4, 1e-3, 1e-2, 1e-1})
        for (const int samples : {64, 512, 4096})
            cases.push_back({hits(chance), 32, samples, chance > 0.05 ? 50u : 400u});
    for (const int samples : {64, 1024}) {
        const std::uint64_t trials = samples == 64 ? 400 : 40;
        for (const SampleKind& kind :
             {normal_samples(0.3), exponential_samples(), lognormal_samples(1.0), lognormal_samples(2.0)})
            cases.push_back({kind, 16, samples, trials});
    }
    for (const double share : {0.1, 0.6})
        for (const double number : {0.6, 1.0, 10.0})
            for (const int samples : {16, 64, 256})
                cases.push_back({rare_light(share, number / (256.0 * samples)), 64, samples, 80});
    const double level = sidak_level(significance, 4 * cases.size());
    for (const Case& test : cases)
        for (const Other other : all_others) {
            NoisyImage how;
            how.size = test.size;
            how.samples = test.samples;
            how.contrast = other == Other::same_samples ? 1000.0 : 1.0;
            check_false_alarms(how, test.kind, other,
                               other == Other::more_samples ? test.trials / 8 : test.trials, level);
        }
}

TEST_CASE("the bias that compare says it would find is found", "[statistical][compare]")
{
    constexpr std::uint64_t trials = 150;
    for (const SampleKind& kind : {exponential_samples(), hits(0.1)}) {
        NoisyImage how;
        const double bias = *compare_pair(how, kind, Other::exact, 1).significance.detectable_bias;
        INFO(kind.name << ", bias " << bias);
        CHECK(bias < 0.2);
        const auto share_found = [&](double factor) {
            how.bias = factor;
            std::uint64_t found = 0;
            for (std::uint64_t i = 0; i < trials; ++i)
                if (compare_pair(how, kind, Other::exact, i + 2).verdict == Verdict::differs) ++found;
            return found;
        };
        // Of 150 that each have a chance of 0.85, fewer than 115 would be found in 1 % of the tests.
        CHECK(share_found(1.0 + bias) >= 115);
        CHECK(share_found(1.0 - bias) >= 115);
        CHECK(share_found(1.0 + 0.25 * bias) <= 75); // it is not simply always found
    }
}
