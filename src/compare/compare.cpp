// SPDX-License-Identifier: MIT
#include "plumb/compare/compare.h"

#include "compare/alignment.h"
#include "compare/flip.h"
#include "compare/metrics.h"
#include "compare/verdict.h"
#include "plumb/base/error.h"

#include <fmt/format.h>

namespace plumb {

namespace {

bool are_identical(const ComparedImage& a, const ComparedImage& b)
{
    return std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
                      [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

// The colours for FLIP, which must be finite: black in both where one is not.
std::vector<Color> finite_colors(const ComparedImage& image, const ComparedImage& other)
{
    std::vector<Color> colors;
    colors.reserve(image.pixels());
    for (std::size_t i = 0; i < image.pixels(); ++i)
        colors.push_back(image.is_finite(i) && other.is_finite(i) ? image.color(i) : Color());
    return colors;
}

void add_flip(Comparison& comparison, const ComparedImage& a, const ComparedImage& b, FlipMode mode)
{
    if (mode == FlipMode::none) return;
    const auto flip = mode == FlipMode::ldr ? ldr_flip : hdr_flip;
    FlipError error = flip(finite_colors(b, a), finite_colors(a, b), comparison.width, comparison.height);
    comparison.metrics.flip = error.mean;
    comparison.flip_map = std::move(error.map);
}

bool is_exceeded(const Metrics& metrics, const Threshold& threshold)
{
    const double value = metric_value(metrics, threshold.metric);
    return threshold.metric == "psnr" ? !(value >= threshold.limit) : !(value <= threshold.limit);
}

Verdict find_outcome(const Comparison& comparison, const CompareSettings& options, std::uint64_t tolerated)
{
    const std::optional<Verdict> of_noise = comparison.significance.verdict;
    if (!comparison.exceeded.empty() || of_noise == Verdict::differs) return Verdict::differs;
    if (comparison.non_finite.only_a + comparison.non_finite.only_b > tolerated) return Verdict::differs;
    if (comparison.identical || of_noise == Verdict::passes) return Verdict::passes;
    return !of_noise && !options.thresholds.empty() ? Verdict::passes : Verdict::undecided;
}

Comparison compare_images(ComparedImage a, ComparedImage b, const CompareSettings& options)
{
    check_comparable(a, b);
    a.is_exact = options.exact == Side::a;
    b.is_exact = options.exact == Side::b;

    Comparison result;
    result.noise_a = a.is_exact ? "exact" : a.noise;
    result.noise_b = b.is_exact ? "exact" : b.noise;
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
    if (result.identical && result.significance.verdict == Verdict::undecided) {
        result.significance.verdict = Verdict::passes;
        result.significance.reason.clear();
    }
    const Significance& found = result.significance;
    const bool is_hidden =
        found.difference_noise && found.difference_noise->is_hidden; // it may be a mirrored image
    if (options.alignment &&
        (found.verdict == Verdict::differs || (found.verdict == Verdict::undecided && is_hidden)))
        result.alignment = find_alignment(a, b, options, found.shift.has_value());
    for (const Threshold& threshold : options.thresholds)
        if (is_exceeded(result.metrics, threshold)) result.exceeded.push_back(threshold);
    result.verdict = find_outcome(result, options, tolerated_pixels(a, options));
    return result;
}

} // namespace

Comparison compare(const Estimate& a, const Estimate& b, const CompareSettings& settings)
{
    auto [image_a, image_b] = make_compared_images(a.image, b.image, settings);
    const auto take_facts = [](ComparedImage& image, const Estimate& one) {
        image.samples_per_pixel = one.samples_per_pixel;
        image.estimator = one.estimator;
        image.seed = one.seed;
    };
    take_facts(image_a, a);
    take_facts(image_b, b);
    return compare_images(std::move(image_a), std::move(image_b), settings);
}

Comparison compare(const Image& a, const Image& b, const CompareSettings& settings)
{
    auto [image_a, image_b] = make_compared_images(a, b, settings);
    return compare_images(std::move(image_a), std::move(image_b), settings);
}

} // namespace plumb
