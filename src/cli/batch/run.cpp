// SPDX-License-Identifier: MIT
#include "cli/batch/run.h"

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/outputs.h"

#include "base/visible_text.h"

#include <charconv>
#include <chrono>
#include <fmt/format.h>
#include <functional>
#include <new>

namespace plumb {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// A picture of a suite, with what is said of this run.
RenderRequest request_of(const SuiteEntry& entry, const RenderSettings& settings, const BatchRequest& run)
{
    RenderRequest request;
    request.scene = entry.scene.string();
    request.settings = settings;
    request.quiet =
        run.quiet || !log_is_terminal(); // one bar after the other, no lines between those of the table
    request.threads = run.threads;
    request.keep_interrupted = false; // half a picture is neither a result nor a reference
    return request;
}

// Without a word: warnings are part of the report.
LoadedScene load_scene_of(const SuiteEntry& entry, SceneRequest request)
{
    std::error_code ignored;
    if (!fs::exists(entry.scene, ignored)) {
        const Diagnostic missing{
            Severity::error, entry.scene_at,
            fmt::format("scene file '{}' does not exist{}", entry.scene.string(), entry.scene_way_out)};
        throw SceneError({missing});
    }
    request.quiet = true;
    return load_and_log(request);
}

// Does the work and fills in how long it took and what went wrong.
void attempt(BatchResult& result, const std::function<void()>& work)
{
    const auto start = Clock::now();
    const auto fail = [&](std::string problem) {
        result.verdict = BatchVerdict::error;
        result.problem = std::move(problem);
    };
    try {
        work();
    } catch (const SceneError& error) {
        fail(error.what());
    } catch (const FileError& error) {
        fail(Diagnostic{Severity::error, error.location(), error.what()}.text());
    } catch (const std::bad_alloc&) {
        fail("error: not enough memory");
    } catch (const std::exception& error) {
        fail("error: " + visible_text(error.what()));
    }
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
}

// Throws Error if a signal came.
void check_whole(const Rendered& rendered, BatchResult& result)
{
    result.signal = rendered.signal;
    if (rendered.signal != 0) throw Error("interrupted");
}

// What the picture's header says.
void read_header(BatchResult& result, const Image& image)
{
    for (const auto& [name, value] : image.metadata) {
        const auto* text = std::get_if<std::string>(&value);
        const auto* number = std::get_if<float>(&value);
        if (name == "plumb:rmse" && number) result.noise = static_cast<double>(*number);
        if (name == "plumb:biases" && text) result.biases = *text;
        if (name == "plumb:leftOut" && text)
            std::from_chars(text->data(), text->data() + text->size(), result.left_out);
    }
}

BatchVerdict verdict_of(CompareOutcome outcome)
{
    switch (outcome) {
    case CompareOutcome::passes: return BatchVerdict::passes;
    case CompareOutcome::differs: return BatchVerdict::differs;
    case CompareOutcome::undecided: return BatchVerdict::undecided;
    }
    return BatchVerdict::undecided;
}

// "box_diff.png" for "box.exr".
std::string difference_of(const std::string& picture)
{
    return fs::path(picture).replace_extension().string() + "_diff.png";
}

void compare_with_reference(const BatchJob& job, const BatchRequest& run, const Image& image,
                            BatchResult& result)
{
    const SuiteEntry& entry = job.entry;
    std::error_code ignored;
    if (!fs::exists(entry.reference, ignored))
        throw SceneError(
            {Diagnostic{Severity::error, entry.reference_at,
                        fmt::format("reference '{}' does not exist; 'renderer batch {} --update' makes it",
                                    entry.reference.string(), run.suite)}});
    const Image reference = read_image(entry.reference, true);
    result.how = job.compare;
    try {
        result.comparison = compare(image, reference, result.how);
    } catch (const Error& error) {
        throw Error(fmt::format("cannot compare A, '{}', with B, '{}': {}", result.picture,
                                entry.reference.string(), error.what()));
    }
    result.verdict = verdict_of(result.comparison->outcome);
    const std::string difference = difference_of(result.picture);
    write_image(difference, difference_image(image, reference));
    result.difference = difference;
}

BatchResult result_of(const BatchJob& job, const RenderSettings& settings)
{
    BatchResult result;
    result.title = job.entry.title();
    result.scene = job.entry.scene.string();
    result.reference = job.entry.reference.string();
    result.command = command_text(job.entry.scene, settings);
    return result;
}

std::vector<std::string> warnings_of(const LoadedScene& scene)
{
    std::vector<std::string> warnings;
    for (const Diagnostic& warning : scene.warnings) warnings.push_back(warning.text());
    return warnings;
}

// The title with the number of samples that the scene asks for, which must be nobody else's.
std::string counted_title(const SuiteEntry& entry, const LoadedScene& scene, std::set<std::string>& taken)
{
    if (entry.settings.contains("spp")) return entry.title();
    std::string title = fmt::format("{}_{}", entry.name, render_samples(scene.job, {}));
    if (!taken.insert(title).second)
        throw SceneError({Diagnostic{
            Severity::error, entry.at,
            fmt::format("another entry also writes '{}.exr'; give one of them another name", title)}});
    return title;
}

} // namespace

void make_directory(const fs::path& directory)
{
    std::error_code problem;
    if (!directory.empty()) fs::create_directories(directory, problem);
    if (problem)
        throw Error(
            fmt::format("cannot create the directory '{}': {}", directory.string(), problem.message()));
}

BatchResult run_entry(const BatchJob& job, BatchContext& context)
{
    BatchResult result = result_of(job, job.picture);
    attempt(result, [&] {
        RenderRequest request = request_of(job.entry, job.picture, context.request);
        {
            const LoadedScene scene = load_scene_of(job.entry, request);
            result.warnings = warnings_of(scene);
            result.title = counted_title(job.entry, scene, context.titles);
            const std::string stem = (context.directory / result.title).string();
            request.outputs = {stem + ".exr", stem + ".png"};
            const std::string key = picture_key(request, scene);
            result.up_to_date =
                !context.request.force && context.state.is_up_to_date(result.title, key, request.outputs);
            if (!result.up_to_date) {
                make_directory(fs::path(stem).parent_path());
                std::vector<std::string> written = request.outputs;
                if (!job.entry.reference.empty()) written.push_back(difference_of(request.outputs.front()));
                refuse_overwriting_inputs(context.kept, written, {},
                                          "it is a scene or a reference of the suite");
                check_outputs(written, {});
                check_whole(render_and_write(request, scene), result);
                context.state.note(result.title, key, request.outputs);
            }
        }
        const Image image = read_image(request.outputs[0], true);
        result.picture = request.outputs[0];
        result.screen_picture = request.outputs[1];
        read_header(result, image);
        result.verdict = BatchVerdict::rendered;
        if (!job.entry.reference.empty()) compare_with_reference(job, context.request, image, result);
    });
    return result;
}

BatchResult make_reference(const BatchJob& job, const BatchRequest& run, const KeptFiles& kept)
{
    BatchResult result = result_of(job, job.reference);
    result.title = result.reference;
    attempt(result, [&] {
        RenderRequest request = request_of(job.entry, job.reference, run);
        request.outputs = {result.reference};
        if (job.entry.reference.extension() == ".exr")
            request.outputs.push_back(fs::path(job.entry.reference).replace_extension(".png").string());
        const LoadedScene scene = load_scene_of(job.entry, request);
        result.warnings = warnings_of(scene);
        make_directory(job.entry.reference.parent_path());
        refuse_overwriting_inputs(kept, request.outputs, {}, "it is a scene of the suite");
        check_outputs(request.outputs, {});
        const Rendered rendered = render_and_write(request, scene);
        check_whole(rendered, result);
        const Evidence& evidence = rendered.report.evidence;
        if (evidence.noise) result.noise = evidence.noise->rmse;
        result.left_out = evidence.left_out.count;
        result.verdict = BatchVerdict::made;
    });
    return result;
}

} // namespace plumb
