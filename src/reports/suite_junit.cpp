// SPDX-License-Identifier: MIT

// junit.xml, as continuous integration reads it: a test case for each image. Undecided is a failure, for it is no
// agreement.

#include "base/text.h"
#include "base/xml_text.h"
#include "plumb/reports/suite_report.h"

#include <fmt/format.h>

namespace plumb {

namespace {

std::string details(const SuiteResult& result)
{
    std::string text = result.problem.empty() ? reason_text(result) : result.problem;
    if (!result.command.empty()) text += "\n" + result.command;
    if (!result.compare_command.empty()) text += "\n" + result.compare_command;
    if (!result.stale.empty()) text += "\n" + stale_text(result);
    if (!result.accept_command.empty()) text += "\nto accept it: " + result.accept_command;
    if (result.comparison) text += fmt::format("\nrmse {:.6g}", result.comparison->metrics.rmse);
    if (result.noise) text += fmt::format("\nnoise {:.6g}", *result.noise);
    return text;
}

std::string outcome(const SuiteResult& result)
{
    const std::string message = xml_text(reason_text(result));
    if (result.state == JobState::not_run) return fmt::format("      <skipped message=\"{}\"/>\n", message);
    if (!result.is_failure()) return {};
    const std::string_view element = result.state == JobState::failed ? "error" : "failure";
    return fmt::format("      <{0} type=\"{1}\" message=\"{2}\">{3}</{0}>\n", element, result_word(result),
                       message, xml_text(details(result)));
}

} // namespace

std::string suite_junit(const SuiteRun& run)
{
    const std::string suite = xml_text(std::filesystem::path(run.suite).stem().string());
    const std::string counts =
        fmt::format(R"(tests="{}" failures="{}" errors="{}" skipped="{}" time="{:.3f}")", run.results.size(),
                    run.count(Verdict::differs) + run.count(Verdict::undecided), run.count(JobState::failed),
                    run.count(JobState::not_run), run.seconds);
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    text += fmt::format("<testsuites {}>\n  <testsuite name=\"{}\" {}>\n", counts, suite, counts);
    for (const SuiteResult& result : run.results) {
        const std::string body = outcome(result);
        text += fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"{}", suite,
                            xml_text(result.title), result.seconds, body.empty() ? "/>\n" : ">\n");
        if (!body.empty()) text += body + "    </testcase>\n";
    }
    return text + "  </testsuite>\n</testsuites>\n";
}

} // namespace plumb
