// SPDX-License-Identifier: MIT
#include "plumb/reports/comparison_report.h"

#include "reports/exit_codes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plumb {

namespace {

constexpr double smallest_p = 1e-300;

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
    return text + fmt::format("   {:<8} {}: {} {} and {}\n", p_text(test.p), place_text(test.place),
                              c.channels[static_cast<std::size_t>(test.channel)], number(test.mean_a),
                              number(test.mean_b));
}

std::string spread_text(const SpreadTest& test)
{
    return fmt::format(
        "  {:<16} {:>8} {:>8} {:>8}   {:<8}{}\n", fmt::format("all of {0}x{0}", test.size), 1,
        test.is_tested ? 1 : 0, "", test.is_tested ? p_text(test.p) : "",
        test.is_tested ? fmt::format(" sum of the squared differences: {:.3g} times the noise", test.ratio)
                       : "");
}

// Where the noise is known from, if one of the images does not say.
std::string noise_text(const Comparison& c)
{
    std::string text = fmt::format("A {}, B {}", c.noise_a, c.noise_b);
    if (!c.significance.difference_noise) return row("error bars", text);
    const DifferenceNoise& noise = *c.significance.difference_noise;
    text = row("error bars", text + ": the spread of A - B tells of the noise");
    if (noise.reach && *noise.reach > 0)
        text += row(
            "", fmt::format("it is correlated over {} pixel{}: the variance of sums is {:.3g} times larger",
                            *noise.reach, *noise.reach == 1 ? "" : "s", noise.inflation));
    return text;
}

std::string finding_text(const Significance& s, const CompareSettings& options)
{
    if (!s.verdict) return fmt::format("no verdict on the noise: {}", s.reason);
    switch (*s.verdict) {
    case Verdict::passes:
        return fmt::format("no difference beyond the noise at significance {}", options.significance);
    case Verdict::differs:
        return fmt::format("a difference beyond the noise at significance {}: {} of the pixels differ",
                           options.significance, percent(s.differing, s.pixels));
    case Verdict::undecided: return fmt::format("undecided: {}", s.reason);
    }
    return {};
}

std::string significance_text(const Comparison& c, const CompareSettings& options)
{
    const Significance& s = c.significance;
    std::string text;
    if (!s.scales.empty() && (c.noise_a != c.noise_b || s.difference_noise)) text += noise_text(c);
    if (!s.scales.empty()) {
        text += fmt::format("  {:<16} {:>8} {:>8} {:>8}   {:<8} {}\n", "tests of", "all", "tested", "differ",
                            "p", "largest difference: A and B");
        for (const ScaleTest& scale : s.scales) text += scale_text(c, scale);
        for (const SpreadTest& test : s.spread) text += spread_text(test);
        if (s.detectable_bias)
            text +=
                row("power",
                    fmt::format("a bias of {:.3g} % of the whole would have been found with 90 % probability",
                                100.0 * *s.detectable_bias));
    }
    text += row("noise", finding_text(s, options));
    if (s.shift && s.shift->p <= options.significance)
        text += row("shift",
                    fmt::format("A {} fits B better than A does, beyond the noise (p {}; {} shifts tried)",
                                s.shift->change, p_text(s.shift->p), s.shift->tried));
    if (c.alignment)
        text +=
            row("alignment", fmt::format("A {} agrees with B (p {}; {} changes tried)", c.alignment->change,
                                         p_text(c.alignment->p), c.alignment->tried));
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

std::string p_text(double p, int digits)
{
    return p < smallest_p ? "< 1e-300" : fmt::format("{:.{}g}", p, digits);
}

double p_number(double p)
{
    return p < smallest_p ? smallest_p : p;
}

std::string_view verdict_word(Verdict verdict)
{
    switch (verdict) {
    case Verdict::passes: return "passes";
    case Verdict::differs: return "differs";
    case Verdict::undecided: return "undecided";
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
    return text + fmt::format("{}\n", verdict_word(comparison.verdict));
}

int exit_code_of(Verdict verdict)
{
    switch (verdict) {
    case Verdict::passes: return exit_code::done;
    case Verdict::differs: return exit_code::differs;
    case Verdict::undecided: return exit_code::undecided;
    }
    return exit_code::undecided;
}

} // namespace plumb
