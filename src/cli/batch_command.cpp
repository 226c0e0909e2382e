// SPDX-License-Identifier: MIT
#include "cli/batch/run.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/text_file.h"

#include "base/visible_text.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

bool is_chosen(const std::string& title, const std::string& filter)
{
    if (filter.find_first_of("*?") != filter.npos) return matches_pattern(title, filter);
    return title.find(filter) != title.npos;
}

std::vector<BatchJob> chosen(const std::vector<BatchJob>& jobs, const BatchRequest& request)
{
    std::vector<BatchJob> result;
    for (const BatchJob& job : jobs)
        if (is_chosen(job.entry.title(), request.filter)) result.push_back(job);
    if (result.empty())
        throw Error(fmt::format("no image of '{}' matches '{}'; the first image is {}", request.suite,
                                request.filter, jobs.front().entry.title()));
    return result;
}

// References, too, unless they are to be made.
std::vector<fs::path> files_to_keep(const std::vector<BatchJob>& jobs, const BatchRequest& request)
{
    std::set<fs::path> files = {request.suite};
    for (const BatchJob& job : jobs) {
        files.insert(job.entry.scene);
        if (!request.update && !job.entry.reference.empty()) files.insert(job.entry.reference);
    }
    return {files.begin(), files.end()};
}

// Runs one job after the other, with a line on the console for each, until a signal comes, or one fails if that is asked for.
template <class Run>
BatchRun run_all(const std::vector<BatchJob>& jobs, const BatchRequest& request, const Run& run)
{
    const auto start = std::chrono::steady_clock::now();
    std::size_t width = 0;
    for (const BatchJob& job : jobs)
        width = std::max(width, (request.update ? job.entry.reference.string() : job.entry.title()).size());

    BatchRun all;
    all.suite = request.suite;
    bool stopped = false;
    for (const BatchJob& job : jobs) {
        if (stopped) {
            all.results.emplace_back();
            all.results.back().title = job.entry.title();
            all.results.back().scene = job.entry.scene.string();
            continue;
        }
        const BatchResult& result = all.results.emplace_back(run(job));
        if (!request.quiet || result.verdict == BatchVerdict::error) print_output(result_line(result, width));
        finish_output(); // so far
        all.signal = result.signal;
        stopped = result.signal != 0 || (request.fail_fast && result.verdict > BatchVerdict::passes);
    }
    all.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return all;
}

// Whether the reference would be another picture.
bool makes_another(const BatchJob& a, const BatchJob& b)
{
    return a.entry.scene != b.entry.scene || a.reference != b.reference;
}

// One job for each reference of the chosen ones: the first in the suite that names it.
std::vector<BatchJob> reference_makers(const std::vector<BatchJob>& jobs,
                                       const std::vector<BatchJob>& chosen_jobs)
{
    std::vector<BatchJob> makers;
    Diagnostics diagnostics;
    const auto with = [](const fs::path& reference) {
        return [&reference](const BatchJob& job) { return job.entry.reference == reference; };
    };
    for (const BatchJob& job : chosen_jobs) {
        const fs::path& reference = job.entry.reference;
        if (reference.empty() || std::any_of(makers.begin(), makers.end(), with(reference))) continue;
        const BatchJob& maker = *std::find_if(jobs.begin(), jobs.end(), with(reference));
        makers.push_back(maker);
        if (maker.entry.reference_settings.contains("spp")) continue;
        for (const BatchJob& other : jobs)
            if (other.entry.reference == reference && makes_another(other, maker))
                diagnostics.error(
                    maker.entry.reference_at,
                    fmt::format("several entries share '{}'; say how the first of them, '{}', makes it: "
                                R"(reference-spp="...")",
                                reference.string(), maker.entry.title()));
    }
    if (diagnostics.has_errors()) throw SceneError(diagnostics.all());
    if (makers.empty()) throw Error("no entry has a reference to make");
    return makers;
}

int update(const BatchRequest& request, const std::vector<BatchJob>& jobs,
           const std::vector<BatchJob>& chosen_jobs)
{
    const KeptFiles kept(files_to_keep(jobs, request));
    const BatchRun run = run_all(reference_makers(jobs, chosen_jobs), request,
                                 [&](const BatchJob& job) { return make_reference(job, request, kept); });
    if (!request.quiet) print_output(summary_text(run) + "\n");
    return run.exit_code();
}

void write_reports(const BatchRun& run)
{
    const fs::path directory = run.directory;
    write_text_file(directory / "report.json", batch_json(run));
    write_text_file(directory / "junit.xml", batch_junit(run));
    write_text_file(directory / "summary.md", batch_markdown(run));
    write_text_file(directory / "report.html", batch_html(run));
}

} // namespace

int batch_command(const BatchRequest& request)
{
    const std::vector<BatchJob> jobs = plan_batch(request.suite, request.definitions);
    const std::vector<BatchJob> chosen_jobs = chosen(jobs, request);
    if (request.update) return update(request, jobs, chosen_jobs);

    const fs::path directory = request.directory.empty() ? fs::path("batch") / fs::path(request.suite).stem()
                                                         : fs::path(request.directory);
    make_directory(directory);
    for (const char* report : {"report.json", "junit.xml", "summary.md", "report.html", "state.txt"})
        check_text_path(directory / report);
    BatchContext context{
        request, directory, BatchState(directory), {}, KeptFiles(files_to_keep(jobs, request))};
    for (const BatchJob& job : jobs)
        if (job.entry.settings.contains("spp")) context.titles.insert(job.entry.title());

    BatchRun run =
        run_all(chosen_jobs, request, [&](const BatchJob& job) { return run_entry(job, context); });
    run.directory = directory.string();
    write_reports(run);
    if (!request.quiet)
        print_output(fmt::format("{}; reports: {}\n", summary_text(run),
                                 visible_text((directory / "report.html").string())));
    return run.exit_code();
}

} // namespace plumb
