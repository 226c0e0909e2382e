// SPDX-License-Identifier: MIT
#include "plumb/reports/test_report.h"
#include "plumb/reports/comparison_report.h"

#include "base/text.h"
#include "base/visible_text.h"
#include "reports/json_document.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plumb {

namespace {

std::string run_text(const TestResult& result, const TestRun& run, TestType type)
{
    const std::string p = run.problem.empty() ? "p " + p_text(run.p, 4) : run.problem;
    const std::string_view verdict = run.p >= result.level ? "passed" : "rejected";
    if (type == TestType::ttest)
        return fmt::format("mean {:.6g} +- {:.2g}, reference {:.6g}, {}: {}", run.mean,
                           std::sqrt(run.variance / static_cast<double>(run.samples)), result.reference, p,
                           verdict);
    return fmt::format("chi2 {:.4g} of {} degrees of freedom, {}: {}", run.statistic, run.degrees_of_freedom,
                       p, verdict);
}

void write_run(JsonWriter& json, const TestRun& run, TestType type)
{
    json.begin_object();
    json.integer("samples", run.samples);
    if (type == TestType::ttest) {
        json.number("mean", run.mean);
        json.number("variance", run.variance);
    }
    json.number(type == TestType::ttest ? "t" : "chi2", run.statistic);
    json.number("degrees_of_freedom", run.degrees_of_freedom);
    json.number("p", p_number(run.p));
    if (!run.problem.empty()) json.text("problem", run.problem);
    json.end_object();
}

void write_file(JsonWriter& json, const TestReport& report)
{
    const TestType type = report.file.type;
    json.begin_object();
    json.text("file", report.path);
    json.text("type", type_name(type));
    json.number("significance_level", report.file.significance_level);
    json.number("level", test_level(report.file));
    if (!report.file.scenes.empty()) json.text("dialect", to_string(report.file.scenes.front().dialect.name));
    json.begin_array("tests");
    for (const TestResult& result : report.results) {
        json.begin_object();
        json.text("name", result.name);
        if (type == TestType::ttest) json.number("reference", result.reference);
        json.boolean("passed", result.passed());
        json.begin_array("runs");
        for (const TestRun& run : result.runs) write_run(json, run, type);
        json.end_array();
        json.end_object();
    }
    json.end_array();
    json.integer("passed", report.passed());
    json.integer("total", report.results.size());
    json.end_object();
}

} // namespace

std::size_t TestReport::passed() const
{
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(), [](const TestResult& r) { return r.passed(); }));
}

std::string_view type_name(TestType type)
{
    return type == TestType::ttest ? "ttest" : "chi2test";
}

std::string result_text(const TestResult& result, TestType type)
{
    std::string text =
        fmt::format("  {}: {}\n", visible_text(result.name), run_text(result, result.runs.front(), type));
    if (result.runs.size() > 1)
        text += fmt::format("    again with {} samples: {}\n", count_text(result.runs.back().samples),
                            run_text(result, result.runs.back(), type));
    return text;
}

std::string test_json(const std::vector<TestReport>& reports, std::uint64_t seed)
{
    JsonWriter json;
    begin_document(json, "test");
    json.integer("seed", seed);
    json.begin_array("files");
    for (const TestReport& report : reports) write_file(json, report);
    json.end_array();
    json.end_object();
    return std::move(json).finish();
}

} // namespace plumb
