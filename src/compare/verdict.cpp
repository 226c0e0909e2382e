// SPDX-License-Identifier: MIT
#include "compare/verdict.h"

#include "compare/metrics.h"
#include "compare/paired_test.h"
#include "compare/shift_test.h"
#include "compare/significance.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr double share_of_shifts = 0.05; // of the chance of a false alarm

// Rounded to integers and clipped at 1: the mean of noisy pixels is not that of the light.
bool is_unfit(const ComparedImage& image)
{
    return image.is_for_screens && !image.is_exact && !image.knows_noise();
}

std::string hidden_text(const ComparedImage& a, const DifferenceNoise& noise)
{
    if (!noise.reach)
        return "A - B is correlated over more than 10 pixels, as after a denoiser or a wide filter; pass "
               "several "
               "images of other seeds";
    const bool is_a = !a.knows_noise();
    return fmt::format(
        "{0} shows no noise of its own beside that of {1}, as after a denoiser; if it has none, pass "
        "--exact {0}",
        is_a ? "A" : "B", is_a ? "B" : "A");
}

// What the tests of sums do not see: the differences at an edge have either sign.
void find_shift(const ComparedImage& a, const ComparedImage& b, const CompareSettings& options,
                Significance& result)
{
    result.shift = test_shifts(a, b);
    if (!result.shift) return;
    result.shift->p = std::min(1.0, result.shift->p / share_of_shifts);
    result.p = std::min(result.p, result.shift->p);
    if (result.shift->p > options.significance) return;
    result.verdict = Verdict::differs;
    result.reason.clear();
    result.differing = result.pixels;
    result.untested = 0;
    for (std::uint16_t& size : result.rejected_by)
        if (size == 0) size = Significance::whole_image;
}

} // namespace

std::uint64_t tolerated_pixels(const ComparedImage& a, const CompareSettings& options)
{
    return static_cast<std::uint64_t>(static_cast<double>(a.pixels()) * options.fail_percent / 100.0);
}

Significance find_significance(const ComparedImage& a, const ComparedImage& b, const CompareSettings& options)
{
    Significance result;
    const auto without_tests = [&result](std::optional<Verdict> verdict, std::string reason) {
        result.verdict = verdict;
        result.reason = std::move(reason);
        return result;
    };
    if (!options.verdict) return without_tests(std::nullopt, "only the limits decide");
    if (a.is_exact && b.is_exact) return without_tests(std::nullopt, "neither image has noise");
    if (is_unfit(a) && is_unfit(b))
        return without_tests(
            std::nullopt, a.display.empty()
                              ? "both images are rounded to integers and clipped at 1, which changes their "
                                "means"
                              : fmt::format("both images were developed for screens ({})", a.display));
    if (is_unfit(a) || is_unfit(b))
        return without_tests(
            Verdict::undecided,
            fmt::format("{0} is rounded to integers and clipped at 1, which changes its means; write "
                        "it as .exr, or pass --exact {0} if it has no noise",
                        is_unfit(a) ? "A" : "B"));

    // Of layers, say, that have no noise.
    if (!a.knows_noise() && !b.knows_noise() && !options.thresholds.empty())
        return without_tests(std::nullopt, "neither image has variance channels, and limits are given");

    const bool is_paired = !a.knows_noise() || !b.knows_noise();
    CompareSettings how = options;
    constexpr double rounding_of_half = 4.8828125e-4; // 2^-11
    if (a.is_half || b.is_half) how.rounding = std::max(how.rounding, rounding_of_half);
    result = is_paired ? test_paired(a, b, how) : test_significance(a, b, options);
    const std::uint64_t tolerated = tolerated_pixels(a, options);
    const bool nothing_is_tested = // then nobody can tolerate it
        result.differing == 0 && result.untested + count_non_finite(a, b).both >= result.pixels;
    if (result.differing > tolerated) {
        result.verdict = Verdict::differs;
    } else if (result.difference_noise && result.difference_noise->is_hidden) {
        result.verdict = Verdict::undecided;
        result.reason = hidden_text(a, *result.difference_noise);
    } else if (nothing_is_tested || result.differing + result.untested > tolerated) {
        result.verdict = Verdict::undecided;
        result.reason = fmt::format("{} of {} pixels lie in no square where the samples support a test",
                                    result.untested, result.pixels);
    } else {
        result.verdict = Verdict::passes;
    }
    if (is_paired && options.alignment && result.verdict != Verdict::differs)
        find_shift(a, b, options, result);
    return result;
}

} // namespace plumb
