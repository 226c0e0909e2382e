// SPDX-License-Identifier: MIT
#include "plumb/experiments/suite_run.h"

#include "base/text.h"
#include "base/text_file.h"
#include "base/visible_text.h"
#include "experiments/suite_state.h"
#include "rendering/output_files.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <new>
#include <set>

namespace plumb {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_chosen(const std::string& title, const std::string& filter)
{
    if (filter.find_first_of("*?") != filter.npos) return matches_pattern(title, filter);
    return title.find(filter) != title.npos;
}

// Whether the reference would be another image.
bool makes_another(const SuiteJob& a, const SuiteJob& b)
{
    return a.entry.scene != b.entry.scene || a.reference != b.reference;
}

// One job for each reference of the chosen ones: the first in the suite that names it.
std::vector<SuiteJob> reference_makers(const std::vector<SuiteJob>& jobs, const std::vector<SuiteJob>& chosen)
{
    std::vector<SuiteJob> makers;
    Diagnostics diagnostics;
    const auto with = [](const fs::path& reference) {
        return [&reference](const SuiteJob& job) { return job.entry.reference == reference; };
    };
    for (const SuiteJob& job : chosen) {
        const fs::path& reference = job.entry.reference;
        if (reference.empty() || std::any_of(makers.begin(), makers.end(), with(reference))) continue;
        const SuiteJob& maker = *std::find_if(jobs.begin(), jobs.end(), with(reference));
        makers.push_back(maker);
        if (maker.entry.reference_settings.contains("spp")) continue;
        for (const SuiteJob& other : jobs)
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

// Scenes and, unless they are to be made, references.
std::vector<fs::path> files_to_keep(const fs::path& suite, const std::vector<SuiteJob>& jobs, bool update)
{
    std::set<fs::path> files = {suite};
    for (const SuiteJob& job : jobs) {
        files.insert(job.entry.scene);
        if (!update && !job.entry.reference.empty()) files.insert(job.entry.reference);
    }
    return {files.begin(), files.end()};
}

void check_outputs(const std::vector<std::string>& files)
{
    for (const std::string& file : files) check_image_path(file);
    if (const auto twice = listed_twice(files))
        throw Error(fmt::format("'{}' is listed as an output twice", *twice));
}

// "box_diff.png" for "box.exr".
std::string difference_of(const std::string& image)
{
    return fs::path(image).replace_extension().string() + "_diff.png";
}

SuiteResult result_of(const SuiteJob& job, const RenderSettings& settings)
{
    SuiteResult result;
    result.title = job.entry.title();
    result.scene = job.entry.scene.string();
    result.reference = job.entry.reference.string();
    result.command = command_text(job.entry.scene, settings);
    return result;
}

// What the header of an image says that is there already.
void read_header(SuiteResult& result, const Image& image)
{
    for (const auto& [name, value] : image.metadata) {
        const auto* text = std::get_if<std::string>(&value);
        const auto* number = std::get_if<float>(&value);
        if (name == "plumb:rmse" && number) result.noise = static_cast<double>(*number);
        if (name == "plumb:biases" && text) result.biases = *text;
        if (name == "plumb:leftOut" && text) result.left_out = std::strtoull(text->c_str(), nullptr, 10);
    }
}

// The same of one that was just made.
void note_evidence(SuiteResult& result, const Evidence& evidence)
{
    if (evidence.noise)
        result.noise = static_cast<double>(static_cast<float>(evidence.noise->rmse)); // as a header has it
    result.biases = list_text(evidence.ledger.biases);
    result.left_out = evidence.left_out.count;
}

class Runner {
public:
    Runner(const fs::path& suite, const std::vector<SuiteJob>& jobs, const SuiteOptions& options,
           const SessionCallbacks& callbacks)
        : suite_(suite),
          options_(options),
          callbacks_(callbacks),
          state_(options.directory),
          kept_(files_to_keep(suite, jobs, options.update))
    {
        for (const SuiteJob& job : jobs)
            if (job.entry.settings.contains("spp")) titles_.insert(job.entry.title());
    }

    // Never throws: what goes wrong is in the result.
    SuiteResult run(const SuiteJob& job)
    {
        image_.reset();
        reference_.reset();
        SuiteResult result = result_of(job, options_.update ? job.reference : job.image);
        if (options_.update) result.title = result.reference;
        const auto start = Clock::now();
        const auto fail = [&](std::string problem) {
            result.state = JobState::failed;
            result.problem = std::move(problem);
        };
        try {
            if (options_.update)
                make_reference(job, result);
            else
                make_image(job, result);
        } catch (const SceneError& error) {
            fail(error.what());
        } catch (const FileError& error) {
            fail(Diagnostic{Severity::error, error.location(), error.what()}.text());
        } catch (const std::bad_alloc&) {
            fail("error: not enough memory");
        } catch (const std::exception& error) {
            fail("error: " + visible_text(error.what()));
        }
        result.seconds = seconds_since(start);
        return result;
    }

    // Of the last job.
    SuiteImages images() const { return {image_ ? &*image_ : nullptr, reference_ ? &*reference_ : nullptr}; }

private:
    struct Made {
        Image image;
        Evidence evidence;
    };

    // Entries that are next to each other often have one scene.
    RenderTask task_of(const SuiteEntry& entry, const RenderSettings& settings)
    {
        std::error_code ignored;
        if (!fs::exists(entry.scene, ignored))
            throw SceneError({Diagnostic{
                Severity::error, entry.scene_at,
                fmt::format("scene file '{}' does not exist{}", entry.scene.string(), entry.scene_way_out)}});
        if (!last_ || last_->path() != entry.scene || last_->settings() != settings.scene) {
            last_.reset();
            last_ = std::make_unique<SceneFile>(entry.scene, settings.scene);
        }
        return plumb::make_task(*last_, settings);
    }

    static void note_warnings(SuiteResult& result, const LoadedScene& scene)
    {
        for (const Diagnostic& warning : scene.warnings) result.warnings.push_back(warning.text());
    }

    // The title with the number of samples that the scene asks for, which must be nobody else's.
    std::string counted_title(const SuiteEntry& entry, const RenderTask& task)
    {
        if (entry.settings.contains("spp")) return entry.title();
        std::string title = fmt::format("{}_{}", entry.name, task.options.samples_per_pixel);
        if (!titles_.insert(title).second)
            throw SceneError({Diagnostic{
                Severity::error, entry.at,
                fmt::format("another entry also writes '{}.exr'; give one of them another name", title)}});
        return title;
    }

    // Half an image is neither a result nor a reference.
    Made render_whole(const RenderTask& task, const std::vector<std::string>& files, SuiteResult& result)
    {
        RenderSession session(task, {.threads = options_.threads}, callbacks_);
        result.interrupted = session.run() == StopReason::interrupted;
        if (result.interrupted) throw Error("interrupted");
        Evidence evidence = session.evidence();
        Image image = session.image(evidence);
        write_images(files, image, task.settings.output.exposure, packing_of(evidence), {});
        return {std::move(image), std::move(evidence)};
    }

    void make_image(const SuiteJob& job, SuiteResult& result)
    {
        const RenderTask task = task_of(job.entry, job.image);
        note_warnings(result, task.scene);
        result.title = counted_title(job.entry, task);
        const std::string stem = (options_.directory / result.title).string();
        const std::vector<std::string> files = {stem + ".exr", stem + ".png"};
        const std::string key = image_key(task);
        result.up_to_date = !options_.force && state_.is_up_to_date(result.title, key, files);
        if (result.up_to_date) {
            image_ = read_image(files[0], true);
            read_header(result, *image_);
        } else {
            make_directory(fs::path(stem).parent_path());
            std::vector<std::string> written = files;
            if (!job.entry.reference.empty()) written.push_back(difference_of(files[0]));
            kept_.refuse(written, "it is a scene or a reference of the suite");
            check_outputs(written);
            Made made = render_whole(task, files, result);
            state_.note(result.title, key, files);
            note_evidence(result, made.evidence);
            image_ = std::move(made.image);
        }
        result.image = files[0];
        result.screen_image = files[1];
        result.state = JobState::rendered;
        if (!job.entry.reference.empty()) compare_with_reference(job, *image_, result);
    }

    void compare_with_reference(const SuiteJob& job, const Image& image, SuiteResult& result)
    {
        const SuiteEntry& entry = job.entry;
        std::error_code ignored;
        if (!fs::exists(entry.reference, ignored))
            throw SceneError({Diagnostic{
                Severity::error, entry.reference_at,
                fmt::format("reference '{}' does not exist; 'renderer batch {} --update' makes it",
                            entry.reference.string(), suite_.string())}});
        const Image& reference = reference_.emplace(read_image(entry.reference, true));
        result.how = job.compare;
        try {
            result.comparison = compare(image, reference, result.how);
        } catch (const Error& error) {
            throw Error(fmt::format("cannot compare A, '{}', with B, '{}': {}", result.image,
                                    entry.reference.string(), error.what()));
        }
        result.state = JobState::compared;
        result.verdict = result.comparison->verdict;
        const std::string difference = difference_of(result.image);
        write_image(difference, difference_image(image, reference));
        result.difference = difference;
    }

    void make_reference(const SuiteJob& job, SuiteResult& result)
    {
        const fs::path& reference = job.entry.reference;
        std::vector<std::string> files = {reference.string()};
        if (reference.extension() == ".exr")
            files.push_back(fs::path(reference).replace_extension(".png").string());
        const RenderTask task = task_of(job.entry, job.reference);
        note_warnings(result, task.scene);
        make_directory(reference.parent_path());
        kept_.refuse(files, "it is a scene of the suite");
        check_outputs(files);
        const Made made = render_whole(task, files, result);
        if (made.evidence.noise) result.noise = made.evidence.noise->rmse;
        result.left_out = made.evidence.left_out.count;
        result.state = JobState::made;
    }

    const fs::path& suite_;
    const SuiteOptions& options_;
    const SessionCallbacks& callbacks_;
    SuiteState state_;
    KeptFiles kept_;               // that no image may replace
    std::set<std::string> titles_; // that are taken
    std::unique_ptr<SceneFile> last_;
    std::optional<Image> image_, reference_; // of the last job
};

} // namespace

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

std::vector<SuiteJob> chosen_jobs(const fs::path& suite, const std::vector<SuiteJob>& jobs,
                                  const SuiteOptions& options)
{
    std::vector<SuiteJob> chosen;
    for (const SuiteJob& job : jobs)
        if (is_chosen(job.entry.title(), options.filter)) chosen.push_back(job);
    if (chosen.empty())
        throw Error(fmt::format("no image of '{}' matches '{}'; the first image is {}", suite.string(),
                                options.filter, jobs.front().entry.title()));
    return options.update ? reference_makers(jobs, chosen) : chosen;
}

SuiteRun run_suite(const fs::path& suite, const std::vector<SuiteJob>& jobs, const SuiteOptions& options,
                   const SessionCallbacks& callbacks, const SuiteTold& told)
{
    const auto start = Clock::now();
    const std::vector<SuiteJob> chosen = chosen_jobs(suite, jobs, options);
    if (!options.update) {
        make_directory(options.directory);
        check_text_path(options.directory / "state.txt");
    }
    Runner runner(suite, jobs, options, callbacks);
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
    run.seconds = seconds_since(start);
    return run;
}

} // namespace plumb
