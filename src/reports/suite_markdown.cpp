// SPDX-License-Identifier: MIT

// summary.md, for the page of a CI job.

#include "base/text.h"
#include "base/visible_text.h"
#include "plumb/reports/suite_report.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// In a cell of a table: what Markdown or HTML would take for its own becomes plain text.
std::string cell(std::string_view text)
{
    std::string result;
    for (const std::string& line : lines_of(text)) {
        if (!result.empty()) result += "<br>";
        for (const char c : visible_text(line)) {
            if (c == '<')
                result += "&lt;";
            else if (c == '&')
                result += "&amp;";
            else if (std::string_view("|*_`[]\\~").find(c) != std::string_view::npos)
                result += std::string("\\") + c;
            else
                result += c;
        }
    }
    return result;
}

std::string number(std::optional<double> value)
{
    return value ? fmt::format("{:.3g}", *value) : "";
}

} // namespace

std::string suite_markdown(const SuiteRun& run)
{
    std::string text =
        fmt::format("## {}\n\n{} in {}.\n\n", cell(run.suite), summary_text(run), duration_text(run.seconds));
    text += "| image | verdict | rmse | noise | seconds | why |\n"
            "|---|---|--:|--:|--:|---|\n";
    for (const SuiteResult* one : failures_first(run)) {
        const SuiteResult& result = *one;
        std::optional<double> rmse;
        if (result.comparison) rmse = result.comparison->metrics.rmse;
        const bool failed = result.is_failure();
        text += fmt::format(
            "| {} | {} | {} | {} | {} | {} |\n", cell(result.title),
            failed ? fmt::format("**{}**", result_word(result)) : std::string(result_word(result)),
            number(rmse), number(result.noise),
            result.up_to_date ? "up to date" : fmt::format("{:.1f}", result.seconds),
            cell(reason_text(result) + (result.stale.empty() ? "" : "\n" + stale_text(result))));
    }
    for (const SuiteResult* result : failures_first(run))
        if (!result->accept_command.empty() && result->state != JobState::made)
            text += fmt::format("\nTo accept {}:\n\n    {}\n", cell(result->title),
                                visible_text(result->accept_command));
    return text;
}

} // namespace plumb
