// SPDX-License-Identifier: MIT
#include "cli/batch/result.h"
#include "cli/comparison_text.h"

#include "cli/exit_codes.h"
#include "cli/text.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb {

namespace {

constexpr BatchVerdict all_verdicts[] = {
    BatchVerdict::made,      BatchVerdict::passes, BatchVerdict::rendered, BatchVerdict::differs,
    BatchVerdict::undecided, BatchVerdict::error,  BatchVerdict::not_run};

// "3 pass" where verdict_word() says "passes".
std::string_view plural_of(BatchVerdict verdict)
{
    switch (verdict) {
    case BatchVerdict::passes: return "pass";
    case BatchVerdict::differs: return "differ";
    case BatchVerdict::error: return "errors";
    default: return verdict_word(verdict);
    }
}

} // namespace

std::size_t BatchRun::count(BatchVerdict verdict) const
{
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(),
                      [&](const BatchResult& result) { return result.verdict == verdict; }));
}

int BatchRun::exit_code() const
{
    if (signal != 0) return exit_code::signal + signal;
    if (count(BatchVerdict::error) > 0) return exit_code::error;
    if (count(BatchVerdict::differs) > 0) return exit_code::differs;
    if (count(BatchVerdict::undecided) > 0) return exit_code::undecided;
    return exit_code::done;
}

std::string_view verdict_word(BatchVerdict verdict)
{
    switch (verdict) {
    case BatchVerdict::not_run: return "not run";
    case BatchVerdict::made: return "made";
    case BatchVerdict::rendered: return "rendered";
    case BatchVerdict::passes: return "passes";
    case BatchVerdict::undecided: return "undecided";
    case BatchVerdict::differs: return "differs";
    case BatchVerdict::error: return "error";
    }
    return "";
}

std::string reason_text(const BatchResult& result)
{
    if (result.verdict == BatchVerdict::error) return result.problem.substr(0, result.problem.find('\n'));
    if (result.verdict == BatchVerdict::not_run) return "the batch ended before";
    if (!result.comparison) return {};
    const Comparison& comparison = *result.comparison;
    const Significance& noise = comparison.significance;
    std::vector<std::string> reasons;
    for (const Threshold& limit : comparison.exceeded)
        reasons.push_back(fmt::format("{} {:.4g} is {} {:.4g}", limit.metric,
                                      metric_value(comparison.metrics, limit.metric),
                                      limit.metric == "psnr" ? "below" : "above", limit.limit));
    const NonFinite& broken = comparison.non_finite;
    if (broken.only_a + broken.only_b > 0)
        reasons.push_back(fmt::format("{} pixels are not finite in one of the images, the first is {},{}",
                                      broken.only_a + broken.only_b, broken.first->x, broken.first->y));
    if (noise.finding == Finding::different && noise.p < result.how.significance)
        reasons.push_back(fmt::format("the difference exceeds the noise: p {}, {:.3g} % of the pixels",
                                      p_text(noise.p),
                                      100.0 * static_cast<double>(noise.differing) /
                                          static_cast<double>(std::max<std::uint64_t>(noise.pixels, 1))));
    if (result.verdict == BatchVerdict::undecided && !noise.reason.empty()) reasons.push_back(noise.reason);
    return list_text(reasons);
}

std::string summary_text(const BatchRun& run)
{
    std::vector<std::string> parts;
    for (const BatchVerdict verdict : all_verdicts)
        if (const std::size_t count = run.count(verdict); count > 0)
            parts.push_back(
                fmt::format("{} {}", count, count == 1 ? verdict_word(verdict) : plural_of(verdict)));
    std::string text = fmt::format("{}", fmt::join(parts, ", "));
    const auto up_to_date = std::count_if(run.results.begin(), run.results.end(),
                                          [](const BatchResult& result) { return result.up_to_date; });
    if (up_to_date > 0) text += fmt::format("; {} up to date", up_to_date);
    return text;
}

std::string result_line(const BatchResult& result, std::size_t title_width)
{
    const auto number = [](std::string_view name, std::optional<double> value) {
        return value ? fmt::format("{} {:<9.3g}", name, *value) : std::string(name.size() + 10, ' ');
    };
    std::optional<double> rmse;
    if (result.comparison) rmse = result.comparison->metrics.rmse;
    std::string line =
        fmt::format("{:<{}}  {:<9}  {}  {}  {}", visible_text(result.title), title_width,
                    verdict_word(result.verdict), number("rmse", rmse), number("noise", result.noise),
                    result.up_to_date                         ? "up to date"
                    : result.verdict == BatchVerdict::not_run ? ""
                                                              : duration_text(result.seconds));
    line.erase(line.find_last_not_of(' ') + 1);
    if (result.verdict == BatchVerdict::error) return line + "\n" + result.problem + "\n";
    const std::string reason = result.verdict == BatchVerdict::not_run ? "" : reason_text(result);
    return line + "\n" + (reason.empty() ? "" : "    " + reason + "\n");
}

} // namespace plumb
