// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/comparison_text.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/text.h"

#include "plumb/estimator_checks/estimator_check.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// A file, and how its tests went.
struct FileReport {
    std::string path;
    TestFile file;
    std::vector<TestResult> results;

    std::size_t passed() const
    {
        return static_cast<std::size_t>(
            std::count_if(results.begin(), results.end(), [](const TestResult& r) { return r.passed(); }));
    }
};

std::string_view type_name(TestType type)
{
    return type == TestType::ttest ? "ttest" : "chi2test";
}

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

std::string result_text(const TestResult& result, TestType type)
{
    std::string text =
        fmt::format("  {}: {}\n", visible_text(result.name), run_text(result, result.runs.front(), type));
    if (result.runs.size() > 1)
        text += fmt::format("    again with {} samples: {}\n", count_text(result.runs.back().samples),
                            run_text(result, result.runs.back(), type));
    return text;
}

// Where results go: not between the lines of a report on standard output.
class Printer {
public:
    explicit Printer(const TestRequest& request) : quiet_(request.quiet), to_log_(request.json == "-") {}

    void print(const std::string& text) const
    {
        if (quiet_) return;
        if (!to_log_) return print_output(text);
        for (const std::string& line : lines_of(text)) print_log(line);
    }

    void print_result(const std::string& path, const TestResult& result, TestType type) const
    {
        const std::string text = result_text(result, type);
        print(text);
        if (!quiet_ || result.passed()) return;
        print_log(fmt::format("error: {}:", path));
        for (const std::string& line : lines_of(text)) print_log(line);
    }

private:
    bool quiet_;
    bool to_log_;
};

void log_warnings(const TestFile& file)
{
    for (const Diagnostic& warning : file.warnings) print_log(warning);
    if (file.scenes.empty()) return;
    const Dialect& dialect = file.scenes.front().dialect;
    print_log(fmt::format("dialect: {} ({})", to_string(dialect.name), dialect.reason));
}

// All files are read before the first test runs. What is wrong with them is thrown together.
std::vector<FileReport> load_files(const TestRequest& request)
{
    SceneRequest scene;
    scene.settings = request.settings;
    const LoadOptions load = load_options(scene);
    std::vector<FileReport> reports;
    std::vector<Diagnostic> problems;
    bool broken = false;
    for (const std::string& path : request.files) {
        std::error_code ignored;
        try {
            if (!std::filesystem::exists(path, ignored))
                throw Error(fmt::format("test file '{}' does not exist", path));
            reports.push_back({path, load_test(path, load), {}});
        } catch (const SceneError& error) {
            broken = true;
            problems.insert(problems.end(), error.diagnostics().begin(), error.diagnostics().end());
        } catch (const Error& error) {
            broken = true;
            problems.push_back({Severity::error, {}, error.what()});
        }
    }
    if (broken) throw SceneError(std::move(problems));
    return reports;
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
    json.number("p", run.p);
    if (!run.problem.empty()) json.text("problem", run.problem);
    json.end_object();
}

void write_file(JsonWriter& json, const FileReport& report)
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

std::string report_json(const std::vector<FileReport>& reports, std::uint64_t seed)
{
    JsonWriter json;
    json.begin_object();
    json.text("software", "Plumb " PLUMB_VERSION);
    json.integer("seed", seed);
    json.begin_array("files");
    for (const FileReport& report : reports) write_file(json, report);
    json.end_array();
    json.end_object();
    return std::move(json).finish();
}

} // namespace

int test_command(const TestRequest& request)
{
    check_outputs({}, request.json);
    const Printer printer(request);
    std::vector<FileReport> reports = load_files(request);
    std::size_t passed = 0, total = 0;
    for (FileReport& report : reports) {
        const TestType type = report.file.type;
        if (!request.quiet) log_warnings(report.file);
        printer.print(fmt::format("{}: {}, {} samples each, level {:.4g}\n", visible_text(report.path),
                                  type_name(type), count_text(report.file.sample_count),
                                  test_level(report.file)));
        report.results =
            run_tests(report.file, {request.settings.samples.seed, request.threads},
                      [&](const TestResult& result) { printer.print_result(report.path, result, type); });
        printer.print(fmt::format("Passed {}/{} tests.\n", report.passed(), report.results.size()));
        passed += report.passed();
        total += report.results.size();
    }
    if (reports.size() > 1)
        printer.print(fmt::format("All {} files: passed {}/{} tests.\n", reports.size(), passed, total));
    if (!request.json.empty()) write_json(request.json, report_json(reports, request.settings.samples.seed));
    return passed == total ? exit_code::done : exit_code::differs;
}

} // namespace plumb
