// SPDX-License-Identifier: MIT
#include "plumb/experiments/suite_run.h"

#include "base/text_file.h"
#include "experiments/suite_runner.h"

#include <algorithm>
#include <chrono>

namespace plumb {

std::size_t SuiteRun::count(JobState state) const
{
    return static_cast<std::size_t>(std::count_if(
        results.begin(), results.end(), [&](const SuiteResult& result) { return result.state == state; }));
}

std::size_t SuiteRun::count(Verdict verdict) const
{
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(),
                      [&](const SuiteResult& result) { return result.verdict == verdict; }));
}

SuiteRun run_suite(const std::filesystem::path& suite, const std::vector<SuiteJob>& jobs,
                   const SuiteOptions& options, const SessionCallbacks& callbacks, const SuiteTold& told)
{
    const auto start = std::chrono::steady_clock::now();
    const std::vector<SuiteJob> chosen = chosen_jobs(suite, jobs, options);
    make_directory(options.directory);
    if (!options.is_about_references()) check_text_path(options.directory / "state.txt");
    SuiteRunner runner(suite, jobs, options, callbacks);
    SuiteRun run;
    run.suite = suite.string();
    run.directory = options.directory.string();
    bool stopped = false;
    for (const SuiteJob& job : chosen) {
        run.interrupted = run.interrupted || callbacks.is_stopped();
        if (stopped || run.interrupted) {
            run.results.emplace_back();
            run.results.back().title = job.entry.title();
            run.results.back().scene = job.entry.scene.string();
            continue;
        }
        const SuiteResult& result = run.results.emplace_back(runner.run(job));
        if (told) told(result, runner.images());
        run.interrupted = result.interrupted;
        stopped = options.fail_fast && result.is_failure();
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return run;
}

} // namespace plumb
