// SPDX-License-Identifier: MIT
#include "plumb/reports/comparison_report.h"

#include "reports/exit_codes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plumb {

namespace {

std::string row(std::string_view name, std::string_view value)
{
    return fmt::format("  {:<16} {}\n", name, value);
}

std::string number(double value)
{
    return fmt::format("{:.6g}", value);
}

std::string place_text(const PixelRect& place)
{
    if (place.width == 1 && place.height == 1) return fmt::format("pixel {},{}", place.x, place.y);
    return fmt::format("{}x{} at {},{}", place.width, place.height, place.x, place.y);
}

std::string percent(std::uint64_t part, std::uint64_t whole)
{
    return fmt::format("{:.4g} %", 100.0 * static_cast<double>(part) /
                                       static_cast<double>(std::max<std::uint64_t>(whole, 1)));
}

std::string metrics_text(const Comparison& c)
{
    const Metrics& m = c.metrics;
    std::string text;
    text += row("mse", number(m.mse));
    text += row("rmse", number(m.rmse));
    text += row("relmse", number(m.relative_mse));
    text += row("mae", number(m.mae));
    text += row("psnr", std::isfinite(m.psnr) ? number(m.psnr) + " dB" : "infinite: nothing differs");
    text += row("max", m.max > 0.0
                           ? fmt::format("{} at pixel {},{}, channel {}", number(m.max), m.max_pixel.x,
                                         m.max_pixel.y, c.channels[static_cast<std::size_t>(m.max_channel)])
                           : "0");
    if (m.flip) text += row("flip", number(*m.flip) + (c.flip_mode == FlipMode::ldr ? " (LDR)" : " (HDR)"));
    text += row("mean luminance", fmt::format("{} and {}", number(m.mean_a), number(m.mean_b)));
    if (c.corrected && !c.identical) {
        text += row("without noise",
                    fmt::format("mse {}, 95 % between {} and {}; rmse {}", number(c.corrected->squared_error),
                                number(c.corrected->low), number(c.corrected->high),
                                c.corrected->root ? number(*c.corrected->root) : "0"));
        if (c.corrected->high < 0.0 && c.same_random_numbers)
            text += row(
                "",
                "below 0: they differ less than independent noise would, because they have the same seed");
    }
    const NonFinite& n = c.non_finite;
    if (n.first)
        text +=
            row("not finite", fmt::format("{} pixels in A only, {} in B only, {} in both; the first is {},{}",
                                          n.only_a, n.only_b, n.both, n.first->x, n.first->y));
    return text;
}

std::string scale_text(const Comparison& c, const ScaleTest& scale)
{
    const std::string name = scale.size == 0   ? "the whole"
                             : scale.size == 1 ? "pixels"
                                               : fmt::format("{0}x{0} pixels", scale.size);
    std::string text =
        fmt::format("  {:<16} {:>8} {:>8} {:>8}", name, scale.units, scale.tested, scale.rejected);
    if (!scale.largest) return text + "\n";
    const UnitTest& test = *scale.largest;
    return text + fmt::format("   {:<8.2g} {}: {} {} and {}\n", test.p, place_text(test.place),
                              c.channels[static_cast<std::size_t>(test.channel)], number(test.mean_a),
                              number(test.mean_b));
}

std::string finding_text(const Significance& s, const CompareSettings& options)
{
    switch (s.finding) {
    case Finding::not_asked: return fmt::format("no verdict on the noise: {}", s.reason);
    case Finding::same:
        return fmt::format("no difference beyond the noise at significance {}", options.significance);
    case Finding::different:
        return fmt::format("a difference beyond the noise at significance {}: {} of the pixels differ",
                           options.significance, percent(s.differing, s.pixels));
    case Finding::undecided: return fmt::format("undecided: {}", s.reason);
    }
    return {};
}

std::string significance_text(const Comparison& c, const CompareSettings& options)
{
    const Significance& s = c.significance;
    std::string text;
    if (!s.scales.empty()) {
        text += fmt::format("  {:<16} {:>8} {:>8} {:>8}   {:<8} {}\n", "tests of", "all", "tested", "differ",
                            "p", "largest difference: A and B");
        for (const ScaleTest& scale : s.scales) text += scale_text(c, scale);
        if (s.detectable_bias)
            text +=
                row("power",
                    fmt::format("a bias of {:.3g} % of the whole would have been found with 90 % probability",
                                100.0 * *s.detectable_bias));
    }
    text += row("noise", finding_text(s, options));
    return text;
}

std::string threshold_text(const Comparison& c, const CompareSettings& options)
{
    std::string text;
    for (const Threshold& limit : options.thresholds) {
        const auto is_this = [&limit](const Threshold& t) { return t.metric == limit.metric; };
        const bool exceeded = std::any_of(c.exceeded.begin(), c.exceeded.end(), is_this);
        text += row("limit", fmt::format("{} {} {}: {}", limit.metric, limit.metric == "psnr" ? ">=" : "<=",
                                         number(limit.limit), exceeded ? "exceeded" : "kept"));
    }
    return text;
}

} // namespace

std::string_view outcome_word(CompareOutcome outcome)
{
    switch (outcome) {
    case CompareOutcome::passes: return "passes";
    case CompareOutcome::differs: return "differs";
    case CompareOutcome::undecided: return "undecided";
    }
    return "";
}

std::string comparison_text(const Comparison& comparison, const CompareSettings& options)
{
    std::string text = metrics_text(comparison);
    if (comparison.identical)
        text += row("noise", "every pixel is the same in both");
    else
        text += significance_text(comparison, options);
    text += threshold_text(comparison, options);
    return text + fmt::format("{}\n", outcome_word(comparison.outcome));
}

int exit_code_of(CompareOutcome outcome)
{
    switch (outcome) {
    case CompareOutcome::passes: return exit_code::done;
    case CompareOutcome::differs: return exit_code::differs;
    case CompareOutcome::undecided: return exit_code::undecided;
    }
    return exit_code::undecided;
}

} // namespace plumb
