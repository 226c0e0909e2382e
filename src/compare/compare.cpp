// SPDX-License-Identifier: MIT
#include "plumb/compare/compare.h"

#include "compare/flip.h"
#include "compare/metrics.h"
#include "compare/significance.h"
#include "plumb/base/error.h"

#include <fmt/format.h>

namespace plumb {

namespace {

bool are_identical(const Picture& a, const Picture& b)
{
    return std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
                      [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

// The colours for FLIP, which must be finite: black in both where one is not.
std::vector<Color> finite_colors(const Picture& picture, const Picture& other)
{
    std::vector<Color> colors;
    colors.reserve(picture.pixels());
    for (std::size_t i = 0; i < picture.pixels(); ++i)
        colors.push_back(picture.is_finite(i) && other.is_finite(i) ? picture.color(i) : Color());
    return colors;
}

void add_flip(Comparison& comparison, const Picture& a, const Picture& b, FlipMode mode)
{
    if (mode == FlipMode::none) return;
    const auto flip = mode == FlipMode::ldr ? ldr_flip : hdr_flip;
    FlipError error = flip(finite_colors(b, a), finite_colors(a, b), comparison.width, comparison.height);
    comparison.metrics.flip = error.mean;
    comparison.flip_map = std::move(error.map);
}

std::uint64_t tolerated_pixels(const Picture& a, const CompareSettings& options)
{
    return static_cast<std::uint64_t>(static_cast<double>(a.pixels()) * options.fail_percent / 100.0);
}

Significance find_significance(const Picture& a, const Picture& b, const CompareSettings& options)
{
    Significance result;
    const auto without_tests = [&result](Finding finding, std::string reason) {
        result.finding = finding;
        result.reason = std::move(reason);
        return result;
    };
    if (!options.verdict) return without_tests(Finding::not_asked, "only the limits decide");
    if (a.is_exact && b.is_exact) return without_tests(Finding::not_asked, "neither image has noise");
    if (!a.knows_noise() && !b.knows_noise())
        return without_tests(Finding::not_asked, "neither image has variance channels");
    if (!a.knows_noise() || !b.knows_noise())
        return without_tests(Finding::undecided,
                             fmt::format("{0} has no variance channels; if it has no noise, pass --exact {0}",
                                         a.knows_noise() ? "B" : "A"));

    result = test_significance(a, b, options);
    const std::uint64_t tolerated = tolerated_pixels(a, options);
    const bool nothing_is_tested = // then nobody can tolerate it
        result.differing == 0 && result.untested + count_non_finite(a, b).both >= result.pixels;
    if (result.differing > tolerated) {
        result.finding = Finding::different;
    } else if (nothing_is_tested || result.differing + result.untested > tolerated) {
        result.finding = Finding::undecided;
        result.reason = fmt::format("{} of {} pixels lie in no square where the samples support a test",
                                    result.untested, result.pixels);
    } else {
        result.finding = Finding::same;
    }
    return result;
}

bool is_exceeded(const Metrics& metrics, const Threshold& threshold)
{
    const double value = metric_value(metrics, threshold.metric);
    return threshold.metric == "psnr" ? !(value >= threshold.limit) : !(value <= threshold.limit);
}

CompareOutcome find_outcome(const Comparison& comparison, const CompareSettings& options,
                            std::uint64_t tolerated)
{
    const Finding finding = comparison.significance.finding;
    if (!comparison.exceeded.empty() || finding == Finding::different) return CompareOutcome::differs;
    if (comparison.non_finite.only_a + comparison.non_finite.only_b > tolerated)
        return CompareOutcome::differs;
    if (comparison.identical || finding == Finding::same) return CompareOutcome::passes;
    return finding == Finding::not_asked && !options.thresholds.empty() ? CompareOutcome::passes
                                                                        : CompareOutcome::undecided;
}

Comparison compare_pictures(Picture a, Picture b, const CompareSettings& options)
{
    check_comparable(a, b);
    a.is_exact = options.exact == Side::a;
    b.is_exact = options.exact == Side::b;

    Comparison result;
    result.width = a.window.width;
    result.height = a.window.height;
    result.channels = a.channels;
    result.identical = are_identical(a, b);
    result.same_random_numbers = share_random_numbers(a, b);
    result.metrics = measure(a, b);
    result.flip_mode = options.flip.value_or(options.layer.empty() ? FlipMode::hdr : FlipMode::none);
    add_flip(result, a, b, result.flip_mode);
    result.non_finite = count_non_finite(a, b);
    result.corrected = correct_for_noise(a, b);
    result.significance = find_significance(a, b, options);
    if (result.identical && result.significance.finding == Finding::undecided) {
        result.significance.finding = Finding::same;
        result.significance.reason.clear();
    }
    for (const Threshold& threshold : options.thresholds)
        if (is_exceeded(result.metrics, threshold)) result.exceeded.push_back(threshold);
    result.outcome = find_outcome(result, options, tolerated_pixels(a, options));
    return result;
}

} // namespace

Comparison compare(const Estimate& a, const Estimate& b, const CompareSettings& settings)
{
    const auto picture = [&](const Estimate& one, Side side) {
        return make_picture(one.image, {one.samples_per_pixel, one.estimator, one.seed}, side,
                            settings.layer);
    };
    Picture picture_a = picture(a, Side::a); // the first to complain
    return compare_pictures(std::move(picture_a), picture(b, Side::b), settings);
}

Comparison compare(const Image& a, const Image& b, const CompareSettings& settings)
{
    const auto picture = [&](const Image& image, Side side) {
        return make_picture(image, facts_of_header(image), side, settings.layer);
    };
    Picture picture_a = picture(a, Side::a); // the first to complain
    return compare_pictures(std::move(picture_a), picture(b, Side::b), settings);
}

} // namespace plumb
