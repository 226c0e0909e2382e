// SPDX-License-Identifier: MIT
#include "experiments/suite_runner.h"

#include "base/shell_words.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "experiments/foreign_command.h"
#include "experiments/foreign_run.h"
#include "experiments/suite_choice.h"

#include <chrono>
#include <fmt/format.h>
#include <new>

namespace plumb {

namespace {

namespace fs = std::filesystem;

} // namespace

SuiteRunner::SuiteRunner(const fs::path& suite, const std::vector<SuiteJob>& jobs,
                         const SuiteOptions& options, const SessionCallbacks& callbacks)
    : suite_(suite),
      jobs_(jobs),
      options_(options),
      callbacks_(callbacks),
      state_(options.directory),
      kept_(files_to_keep(suite, jobs, options.update.has_value()))
{
    for (const SuiteJob& job : jobs)
        if (job.entry.foreign || job.entry.settings.contains("spp")) titles_.insert(job.entry.title());
}

SuiteResult SuiteRunner::run(const SuiteJob& job)
{
    image_.reset();
    reference_.reset();
    SuiteResult result = result_of(job);
    const auto start = std::chrono::steady_clock::now();
    const auto fail = [&](std::vector<Diagnostic> errors) {
        result.state = JobState::failed;
        result.errors = std::move(errors);
        for (const Diagnostic& error : result.errors)
            result.problem += (result.problem.empty() ? "" : "\n") + error.text();
    };
    const auto fail_because = [&](std::string message) {
        fail({Diagnostic{Severity::error, {}, std::move(message)}});
    };
    try {
        do_job(job, result);
    } catch (const SceneError& error) {
        fail(error.diagnostics());
    } catch (const ProgramError& error) {
        result.program = error.run();
        fail({Diagnostic{Severity::error, error.location(), error.what()}});
        result.problem += output_text(error.run());
    } catch (const FileError& error) {
        fail({Diagnostic{Severity::error, error.location(), error.what()}});
    } catch (const std::bad_alloc&) {
        fail_because("not enough memory");
    } catch (const std::exception& error) {
        fail_because(error.what());
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

void SuiteRunner::do_job(const SuiteJob& job, SuiteResult& result)
{
    if (options_.update)
        make_reference(job, result);
    else if (options_.check_references)
        check_reference(job, result);
    else if (!job.entry.foreign)
        make_image(job, result);
    else if (job.entry.foreign->command.empty())
        take_image(job, result);
    else
        run_program(job, result);
}

SuiteImages SuiteRunner::images() const
{
    return {image_ ? &*image_ : nullptr, reference_ ? &*reference_ : nullptr};
}

SuiteResult SuiteRunner::result_of(const SuiteJob& job) const
{
    const SuiteEntry& entry = job.entry;
    SuiteResult result;
    result.title = options_.is_about_references() ? entry.reference.string() : entry.title();
    result.scene = entry.scene.string();
    result.reference = entry.reference.string();
    if (options_.is_about_references())
        result.command = command_text(entry.scene, job.reference);
    else if (!entry.foreign)
        result.command = command_text(entry.scene, job.image);
    else if (!entry.foreign->command.empty())
        result.command = words_text(
            command_of(request_of(job), 0, fs::absolute(stem_of(entry.title()) + ".exr"), options_.threads));
    return result;
}

RenderTask SuiteRunner::task_of(const SuiteEntry& entry, const RenderSettings& settings)
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

SuiteRunner::Made SuiteRunner::render_whole(const RenderTask& task, const std::vector<std::string>& files,
                                            SuiteResult& result)
{
    check_denoising(files, task.settings.output);
    RenderSession session(task, {.threads = options_.threads}, callbacks_);
    result.interrupted = session.run() == StopReason::interrupted;
    if (result.interrupted) throw Error("interrupted");
    Evidence evidence = session.evidence();
    Image image = session.image(evidence);
    if (!files.empty()) write_images(files, image, task.settings.output, packing_of(evidence), {});
    return {std::move(image), std::move(evidence)};
}

std::string SuiteRunner::suite_command(const std::string& words) const
{
    std::string text = "renderer batch " + shell_quote(suite_.string());
    for (const auto& [name, value] : options_.definitions) text += " -D " + shell_quote(name + "=" + value);
    return text + words;
}

} // namespace plumb
