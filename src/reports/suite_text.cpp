// SPDX-License-Identifier: MIT
#include "plumb/reports/suite_report.h"

#include "plumb/reports/comparison_report.h"

#include "base/text.h"
#include "base/text_file.h"
#include "base/visible_text.h"
#include "reports/exit_codes.h"
#include "reports/suite_history.h"

#include <algorithm>
#include <ctime>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumb {

namespace {

// In the order of the summary. "3 pass" where "1 passes".
struct ResultWord {
    std::string_view one, more;
};
constexpr ResultWord all_words[] = {
    {"made", "made"},           {"passes", "pass"},  {"rendered", "rendered"}, {"differs", "differ"},
    {"undecided", "undecided"}, {"error", "errors"}, {"not run", "not run"}};

} // namespace

int exit_code_of(const SuiteRun& run)
{
    if (run.signal != 0) return exit_code::signal + run.signal;
    if (run.count(JobState::failed) > 0) return exit_code::error;
    if (run.count(Verdict::differs) > 0) return exit_code::differs;
    if (run.count(Verdict::undecided) > 0) return exit_code::undecided;
    return exit_code::done;
}

std::string_view result_word(const SuiteResult& result)
{
    switch (result.state) {
    case JobState::not_run: return "not run";
    case JobState::made: return "made";
    case JobState::rendered: return "rendered";
    case JobState::compared: return verdict_word(result.verdict.value_or(Verdict::undecided));
    case JobState::failed: return "error";
    }
    return "";
}

std::string reason_text(const SuiteResult& result)
{
    if (result.state == JobState::failed) return result.problem.substr(0, result.problem.find('\n'));
    if (result.state == JobState::not_run) return "the batch ended before";
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
    if (noise.verdict == Verdict::differs && noise.p < result.how.significance)
        reasons.push_back(fmt::format("the difference exceeds the noise: p {}, {:.3g} % of the pixels",
                                      p_text(noise.p),
                                      100.0 * static_cast<double>(noise.differing) /
                                          static_cast<double>(std::max<std::uint64_t>(noise.pixels, 1))));
    // Of a reference that is rendered again, the pixels decide.
    if (result.verdict == Verdict::differs && reasons.empty() && !result.stale.empty())
        reasons.push_back(result.stale.back());
    if (result.verdict == Verdict::undecided && !noise.reason.empty()) reasons.push_back(noise.reason);
    return list_text(reasons);
}

std::string stale_text(const SuiteResult& result)
{
    if (result.stale.empty()) return {};
    return fmt::format("the reference is stale: {}", list_text(result.stale));
}

std::string summary_text(const SuiteRun& run)
{
    std::vector<std::string> parts;
    for (const ResultWord& word : all_words) {
        const auto count =
            std::count_if(run.results.begin(), run.results.end(),
                          [&](const SuiteResult& result) { return result_word(result) == word.one; });
        if (count > 0) parts.push_back(fmt::format("{} {}", count, count == 1 ? word.one : word.more));
    }
    std::string text = fmt::format("{}", fmt::join(parts, ", "));
    const auto stale = std::count_if(run.results.begin(), run.results.end(),
                                     [](const SuiteResult& result) { return !result.stale.empty(); });
    if (stale > 0) text += fmt::format("; {} stale", stale);
    const auto up_to_date = std::count_if(run.results.begin(), run.results.end(),
                                          [](const SuiteResult& result) { return result.up_to_date; });
    if (up_to_date > 0) text += fmt::format("; {} up to date", up_to_date);
    return text;
}

std::vector<const SuiteResult*> failures_first(const SuiteRun& run)
{
    const auto rank = [](const SuiteResult* result) {
        if (result->state == JobState::failed) return 0;
        if (result->verdict == Verdict::differs) return 1;
        if (result->verdict == Verdict::undecided) return 2;
        return 3;
    };
    std::vector<const SuiteResult*> order;
    for (const SuiteResult& result : run.results) order.push_back(&result);
    std::stable_sort(order.begin(), order.end(),
                     [&](const SuiteResult* a, const SuiteResult* b) { return rank(a) < rank(b); });
    return order;
}

std::string result_line(const SuiteResult& result, std::size_t title_width)
{
    const auto number = [](std::string_view name, std::optional<double> value) {
        return value ? fmt::format("{} {:<9.3g}", name, *value) : std::string(name.size() + 10, ' ');
    };
    std::optional<double> rmse;
    if (result.comparison) rmse = result.comparison->metrics.rmse;
    std::string line = fmt::format("{:<{}}  {:<9}  {}  {}  {}", visible_text(result.title), title_width,
                                   result_word(result), number("rmse", rmse), number("noise", result.noise),
                                   result.up_to_date                   ? "up to date"
                                   : result.state == JobState::not_run ? ""
                                                                       : duration_text(result.seconds));
    line.erase(line.find_last_not_of(' ') + 1);
    if (result.state == JobState::failed) return line + "\n" + result.problem + "\n";
    const std::string reason = result.state == JobState::not_run ? "" : reason_text(result);
    line += "\n" + (reason.empty() ? "" : "    " + reason + "\n");
    if (const std::string stale = stale_text(result); !stale.empty())
        line += "    " + visible_text(stale) + "\n";
    if (result.state == JobState::made && !result.replaced.empty())
        line += fmt::format("    the old one is '{}'{}\n", visible_text(result.replaced),
                            result.comparison
                                ? fmt::format("; the new one {} it: p {}",
                                              result.comparison->verdict == Verdict::passes ? "agrees with"
                                              : result.comparison->verdict == Verdict::differs
                                                  ? "differs from"
                                                  : "cannot be told from",
                                              p_text(result.comparison->significance.p))
                                : "");
    if (!result.accept_command.empty())
        line += fmt::format("    to {}: {}\n", result.state == JobState::made ? "restore it" : "accept it",
                            visible_text(result.accept_command));
    return line;
}

void write_suite_reports(const SuiteRun& run, const ShownImages& images,
                         const std::filesystem::path& directory)
{
    write_text_file(directory / "report.json", suite_json(run));
    write_text_file(directory / "junit.xml", suite_junit(run));
    write_text_file(directory / "summary.md", suite_markdown(run));
    const std::vector<std::string> history = with_run(read_history(directory / "history.json"), run,
                                                      static_cast<std::uint64_t>(std::time(nullptr)));
    write_text_file(directory / "history.json", history_json(history));
    write_text_file(directory / "report.html", suite_html(run, images, history));
}

void check_suite_reports(const std::filesystem::path& directory)
{
    make_directory(directory);
    for (const char* report : {"report.json", "junit.xml", "summary.md", "report.html", "history.json"})
        check_text_path(directory / report);
}

} // namespace plumb
