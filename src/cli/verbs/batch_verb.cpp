// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/verb_file.h"

#include "base/visible_text.h"
#include "plumb/reports/suite_report.h"
#include "reports/exit_codes.h"

#include <algorithm>

namespace plumb {

namespace {

struct Options : VerbOptions {
    RenderSettings settings; // of them, definitions: of $name in the suite
    std::string directory;   // for images and reports; empty: batch/<suite>
    std::string json;
    std::optional<std::string> update; // SuiteOptions::update
    bool check_references = false;
    bool allow_commands = false;
    std::string filter;
    bool fail_fast = false;
    bool force = false;
    int threads = 0;
};

// The progress of each image, on a terminal: no lines between those of the table.
class Display {
public:
    explicit Display(bool quiet) : quiet_(quiet || !log_is_terminal()) {}
    void show(const Progress& progress)
    {
        if (!shown_) shown_.emplace(quiet_);
        shown_->show(progress);
    }
    void end() { shown_.reset(); }

private:
    bool quiet_;
    std::optional<ProgressDisplay> shown_;
};

SuiteRun run_and_tell(const Options& options, const std::vector<SuiteJob>& jobs, const SuiteOptions& how,
                      ShownImages& shown)
{
    std::size_t width = 0;
    for (const SuiteJob& job : chosen_jobs(options.subject(), jobs, how))
        width = std::max(
            width, (how.is_about_references() ? job.entry.reference.string() : job.entry.title()).size());
    Display display(options.quiet);
    const InterruptGuard guard(Interruption::by_hand);
    const auto tell = [&](const SuiteResult& result, const SuiteImages& images) {
        display.end();
        shown.add(result, images);
        const bool is_shown = options.json != "-" && (!options.quiet || result.state == JobState::failed);
        if (is_shown) print_output(result_line(result, width));
        finish_output(); // so far
    };
    SuiteRun run = run_suite(options.subject(), jobs, how,
                             {.progress = [&](const Progress& progress) { display.show(progress); },
                              .stop = &InterruptGuard::flag()},
                             tell);
    if (run.interrupted) run.signal = InterruptGuard::signal();
    return run;
}

SuiteOptions how_to_run(const Options& options)
{
    SuiteOptions how;
    how.filter = options.filter;
    how.fail_fast = options.fail_fast;
    how.update = options.update;
    how.check_references = options.check_references;
    how.force = options.force;
    how.allow_commands = options.allow_commands;
    how.threads = options.threads;
    how.definitions = options.settings.scene.definitions;
    how.directory = options.directory.empty()
                        ? std::filesystem::path("batch") / std::filesystem::path(options.subject()).stem()
                        : std::filesystem::path(options.directory);
    return how;
}

// Those of references leave those of images alone.
std::filesystem::path report_directory(const SuiteOptions& how)
{
    return how.is_about_references() ? how.directory / "references" : how.directory;
}

int run(const Options& options)
{
    const std::string& suite = options.subject();
    const std::vector<SuiteJob> jobs = plan_suite(suite, options.settings.scene.definitions);
    const SuiteOptions how = how_to_run(options);
    const std::vector<SuiteJob> chosen = chosen_jobs(suite, jobs, how);
    if (chosen.empty()) {
        SuiteRun nothing;
        nothing.suite = suite;
        write_json(options.json, suite_json(nothing));
        if (!options.quiet && options.json != "-")
            print_output("no reference is missing; --update=all or --update=NAME makes them again\n");
        return exit_code::done;
    }
    std::size_t shown = 0; // at most
    for (const SuiteJob& job : chosen) shown += job.entry.reference.empty() ? 1 : 2;
    const std::filesystem::path reports = report_directory(how);
    check_suite_reports(reports);
    check_outputs({}, options.json);
    ShownImages images(shown);
    const SuiteRun done = run_and_tell(options, jobs, how, images);
    write_suite_reports(done, images, reports);
    write_json(options.json, suite_json(done));
    if (!options.quiet && options.json != "-")
        print_output(fmt::format("{}; reports: {}\n", summary_text(done),
                                 visible_text((reports / "report.html").string())));
    return exit_code_of(done);
}

void settle(Options& options)
{
    check_output_names({}, {{"--json", options.json}});
    if (options.update && options.check_references)
        throw UsageError("--update and --check-references cannot be used together");
}

constexpr std::string_view about_suites =
    R"(Renders every image that a suite lists, and compares it with its reference if
it has one.

    <suite size="160x120">
        <render scene="cbox.xml" spp="16, 64" reference="ref/cbox.exr"
                reference-spp="1024"/>
        <group name="hw4" max="rmse=0.01" seed="7">
            <render scene="box.xml" name="explicit" reference="ref/*.exr">
                <define name="explicit" value="true"/>
            </render>
        </group>
    </suite>

Images are named after scene (or name) and sample count: cbox_16.exr,
cbox_64.exr, with a .png beside each, hw4/explicit_32.exr. An attribute of
<suite> or <group> applies to everything inside it; an empty value removes it.
File names are relative to the suite; scene="box/*.xml" takes all matching
files. In a reference, * stands for the name of the image. The first entry that
names a reference makes it with --update, with reference-spp, reference-seed and
reference-target-error if they are given. <default>, <include> and $name are
those of the scene language; <define> is -D for the scene.

Images of other programs are there already, or a command makes them:

    <render name="a" image="out/a.exr" reference="ref/a.exr"/>
    <render scene="a.xml" spp="64" reference="ref/a.exr" replicas="4"
            command="mine {scene} -o {image} --seed {seed} --spp {spp}"
            timeout="10m" inputs="a.xml meshes/*.obj"/>

Commands are run only with --allow-commands, without a shell, each in an empty
directory. Placeholders: image, scene, input (the first of inputs), seed, spp,
width, height, replica (from 1), name, threads, directory (of the suite).
replicas="N" runs it N times with other seeds, and compares the mean. A timeout
(default 10m) or Ctrl-C ends the program with all that it has started.

All other attributes are options of `renderer` and `renderer compare`, where A
is the image and B the reference; those without a value take true or false:
)";

constexpr std::string_view about_results = R"(
The output directory also gets report.html, report.json, junit.xml, summary.md
and history.json. An image that is up to date (the hashes of scene, options,
program and image have not changed; for commands of program, inputs, scene file
and words) is compared, but not rendered.
--update makes references that are missing, and no other. It keeps the old ones
that --update=all or --update=NAME replaces, and compares the new with them.
Exit code: 1 if an image could not be rendered or compared, else 3 if one
differs, else 4 if one is undecided, else 0; 2 for wrong usage.
)";

std::string settings_text()
{
    constexpr std::size_t columns = 80;
    std::string text, line;
    for (const std::string_view name : suite_settings()) {
        if (line.size() + 1 + name.size() > columns) {
            text += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "    " : " ") + std::string(name);
    }
    return text + line + "\n";
}

std::string manual()
{
    return std::string(about_suites) + settings_text() + std::string(about_results);
}

OptionTable<Options> table()
{
    const OptionTable<Options> update = {
        {{Topic::output, "--update", "WHAT",
          "make the references that are missing instead of\ncomparing; all, or those of this name or pattern",
          false, false, true},
         [](Options& o, std::string_view, const std::string& t) { o.update = t == "true" ? "missing" : t; }}};
    return join<Options>(
        {text_option<Options>(Topic::output, "--out", "DIR",
                              "directory for images and reports\n(default batch/SUITE)", &Options::directory,
                              "directory"),
         json_option<Options>(), update,
         switch_option<Options>(Topic::output, "--check-references",
                                "render the references as their headers say, and\n"
                                "compare: is any of them stale?",
                                &Options::check_references),
         switch_option<Options>(Topic::running, "--allow-commands", "run the commands of the suite",
                                &Options::allow_commands),
         setting_options<Options>(Topic::scene, &Options::settings, {"define"}),
         text_option<Options>(Topic::running, "--filter", "TEXT",
                              "only images whose names contain this, or match it if\n"
                              "it has * or ?",
                              &Options::filter, "text"),
         switch_option<Options>(Topic::running, "--fail-fast", "stop at the first image that does not pass",
                                &Options::fail_fast),
         switch_option<Options>(Topic::running, "--force", "also render what is up to date", &Options::force),
         threads_option<Options>(), quiet_option<Options>(), help_option<Options>()});
}

} // namespace

struct BatchVerb {
    static Verb make()
    {
        return make_verb<Options>(
            {"batch", "SUITE [options]", "render and compare all images of a suite", "suite", 1, 1, manual()},
            table(), run, settle);
    }
};
template const Verb& verb<BatchVerb>();

} // namespace plumb
