// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/outputs.h"
#include "cli/verb_file.h"
#include "reports/exit_codes.h"

#include "base/text.h"
#include "base/visible_text.h"
#include "plumb/reports/test_report.h"

namespace plumb {

namespace {

struct Options : VerbOptions {
    RenderSettings settings; // of the scenes, and the seed
    int threads = 0;
    std::string json;
};

void settle(Options& options)
{
    check_output_names({}, {{"--json", options.json}});
}

// Where results go: not between the lines of a report on standard output.
class Printer {
public:
    explicit Printer(const Options& options) : quiet_(options.quiet), to_log_(options.json == "-") {}

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
std::vector<TestReport> load_files(const Options& options)
{
    std::vector<TestReport> reports;
    std::vector<Diagnostic> problems;
    bool broken = false;
    for (const std::string& path : options.subjects) {
        std::error_code ignored;
        try {
            if (!std::filesystem::exists(path, ignored))
                throw Error(fmt::format("test file '{}' does not exist", path));
            reports.push_back({path, load_test(path, options.settings), {}});
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

int run(const Options& options)
{
    check_outputs({}, options.json);
    const Printer printer(options);
    std::vector<TestReport> reports = load_files(options);
    std::size_t passed = 0, total = 0;
    for (TestReport& report : reports) {
        const TestType type = report.file.type;
        if (!options.quiet) log_warnings(report.file);
        printer.print(fmt::format("{}: {}, {} samples each, level {:.4g}\n", visible_text(report.path),
                                  type_name(type), count_text(report.file.sample_count),
                                  test_level(report.file)));
        report.results =
            run_tests(report.file, {options.settings.samples.seed, options.threads},
                      [&](const TestResult& result) { printer.print_result(report.path, result, type); });
        printer.print(fmt::format("Passed {}/{} tests.\n", report.passed(), report.results.size()));
        passed += report.passed();
        total += report.results.size();
    }
    if (reports.size() > 1)
        printer.print(fmt::format("All {} files: passed {}/{} tests.\n", reports.size(), passed, total));
    if (!options.json.empty()) write_json(options.json, test_json(reports, options.settings.samples.seed));
    return passed == total ? exit_code::done : exit_code::differs;
}

constexpr std::string_view manual =
    R"(
Runs the test files of the courses, which have <test> for their root, unchanged.

  <test type="ttest"> compares means with references by Student's t-test: of
      each <scene>, the luminance of the light that arrives at random places of
      the film (no filter); or of each <bsdf>, for each of the `angles` between
      wi and the normal in degrees, the luminance of the weights of its samples;
      or of each <emitter> that needs no shape, for each of the `distances` d,
      the luminance of what arrives at (0, 0, d) from it over the density of
      samples. `references` holds one number for each scene, or for each angle
      of each bsdf, bsdf by bsdf, or for each distance of each emitter.
      sampleCount (100000), significanceLevel (0.01).
  <test type="chi2test"> compares the samples of each <bsdf> with its density by
      Pearson's chi-square test on a grid of cos theta x phi, `resolution` (10)
      by twice as many cells, for testCount (5) random directions wi. Cells that
      expect fewer than minExpFrequency (5) samples are pooled. sampleCount (-1:
      5000 a cell), significanceLevel (0.01).

The p-values are those of the courses' statistic, and the level of each test is
Sidak's share of significanceLevel. In these details this program is stricter or
clearer: a sample that is not finite rejects, a black sample counts as one in a
chi2test (one that the bsdf refuses does not), and the scenes' own samplers and
sampleCount are not used.

A test that rejects is repeated once with 100 times the samples and independent
random numbers; both results are printed, and the second one counts. A t-test
assumes a finite variance. Where emitting walls touch, as in a closed box,
next-event estimation has none: samples near the edges are rare and huge,
and the plain t-test rejects correct code several times more often than its
level says. A bias stays when the noise falls to a tenth; such a rejection
usually does not. So a correct renderer seldom fails here, and a mean that is
off by five standard errors always fails. The test cannot detect what is smaller
than the noise of sampleCount samples.

Scenes of a ttest are read in one dialect: that of --dialect, else that of the
attribute of <scene> or <test>, else the one that the file indicates. Only EPFL
and ETH files have ttests, so emitters scatter light unless something indicates
otherwise. The same seed gives the same results for any number of threads.

All files are read before the first test runs. Exit codes: 0 all tests passed,
3 a test failed, 1 a file is wrong, 2 wrong usage.
)";

OptionTable<Options> table()
{
    return join<Options>(
        {json_option<Options>(), setting_options<Options>(Topic::image, &Options::settings, {"seed"}),
         setting_options<Options>(Topic::scene, &Options::settings,
                                  {"define", "dialect", "emitters", "envmap-scale", "lenient"}),
         threads_option<Options>(), setting_options<Options>(Topic::running, &Options::settings, {"isa"}),
         quiet_option<Options>(), help_option<Options>()});
}

} // namespace

struct TestVerb {
    static Verb make()
    {
        return make_verb<Options>({"test", "FILE... [options]", "run a course's statistical tests",
                                   "test file", 1, any_number, std::string(manual)},
                                  table(), run, settle);
    }
};
template const Verb& verb<TestVerb>();

} // namespace plumb
