// SPDX-License-Identifier: MIT
#include "cli/batch/result.h"

#include "cli/exit_codes.h"
#include "cli/text.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

constexpr BatchVerdict all_verdicts[] = {BatchVerdict::passes,  BatchVerdict::rendered,
                                         BatchVerdict::differs, BatchVerdict::undecided,
                                         BatchVerdict::error,   BatchVerdict::not_run};

} // namespace

std::size_t BatchRun::count(BatchVerdict verdict) const
{
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(),
                      [&](const BatchResult& result) { return result.verdict == verdict; }));
}

int BatchRun::exit_code() const
{
    if (count(BatchVerdict::error) > 0) return exit_code::error;
    if (count(BatchVerdict::differs) > 0) return exit_code::differs;
    if (count(BatchVerdict::undecided) > 0) return exit_code::undecided;
    return exit_code::done;
}

std::string_view verdict_word(BatchVerdict verdict)
{
    switch (verdict) {
    case BatchVerdict::not_run: return "not run";
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
    if (result.verdict == BatchVerdict::not_run) return "an earlier one did not pass";
    if (!result.comparison) return {};
    const Comparison& comparison = *result.comparison;
    const Significance& noise = comparison.significance;
    std::vector<std::string> reasons;
    for (const Threshold& limit : comparison.exceeded)
        reasons.push_back(fmt::format("{} {:.4g} is {} {:.4g}", limit.metric,
                                      metric_value(comparison.metrics, limit.metric),
                                      limit.metric == "psnr" ? "below" : "above", limit.limit));
    if (noise.finding == Finding::different)
        reasons.push_back(fmt::format("it differs beyond the noise: p {:.2g}, {:.3g} % of the pixels",
                                      noise.p,
                                      100.0 * static_cast<double>(noise.differing) /
                                          static_cast<double>(std::max<std::uint64_t>(noise.pixels, 1))));
    if (result.verdict == BatchVerdict::undecided && !noise.reason.empty()) reasons.push_back(noise.reason);
    return list_text(reasons);
}

std::string summary_text(const BatchRun& run)
{
    std::string text;
    for (const BatchVerdict verdict : all_verdicts) {
        const std::size_t count = run.count(verdict);
        if (count == 0) continue;
        const bool plural_error = verdict == BatchVerdict::error && count > 1;
        text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, verdict_word(verdict),
                            plural_error ? "s" : "");
    }
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
        fmt::format("{:<{}}  {:<9}  {}  {}  {}", result.title, title_width, verdict_word(result.verdict),
                    number("rmse", rmse), number("noise", result.noise),
                    result.up_to_date                         ? "up to date"
                    : result.verdict == BatchVerdict::not_run ? ""
                                                              : duration_text(result.seconds));
    line.erase(line.find_last_not_of(' ') + 1);
    if (result.verdict == BatchVerdict::error) return line + "\n" + result.problem + "\n";
    const std::string reason = result.verdict == BatchVerdict::not_run ? "" : reason_text(result);
    return line + "\n" + (reason.empty() ? "" : "    " + reason + "\n");
}

} // namespace plumb
