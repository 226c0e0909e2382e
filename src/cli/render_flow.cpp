// SPDX-License-Identifier: MIT
#include "cli/render_flow.h"

#include "base/text.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "plumb/reports/render_report.h"
#include "rendering/checkpoint.h"
#include "rendering/output_files.h"
#include "reports/exit_codes.h"

#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <future>

namespace plumb {

namespace {

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

std::vector<std::filesystem::path> paths_of(const std::vector<InputFile>& inputs)
{
    std::vector<std::filesystem::path> paths;
    for (const InputFile& input : inputs) paths.push_back(input.path);
    return paths;
}

std::string checkpoint_of(const RenderFlow& flow)
{
    return flow.session.checkpoint.file.string();
}

std::vector<std::string> default_outputs(const RenderTask& task)
{
    const std::string stem = std::filesystem::path(task.file).stem().string();
    const bool fixed =
        task.settings.samples.per_pixel || !(task.settings.stop.seconds || task.settings.stop.relative_error);
    const std::string name = fixed ? fmt::format("{}_{}", stem, task.options.samples_per_pixel) : stem;
    return {name + ".exr", name + ".png"};
}

// A part is no image yet: its output is the checkpoint.
std::vector<std::string> images_of(const RenderFlow& flow, const RenderTask& task)
{
    if (flow.session.part) return {};
    return flow.outputs.empty() ? default_outputs(task) : flow.outputs;
}

std::vector<std::string> with_checkpoint(std::vector<std::string> images, const RenderFlow& flow)
{
    if (const std::string file = checkpoint_of(flow); !file.empty()) images.push_back(file);
    return images;
}

// All that a run writes to.
std::vector<std::string> files_written(const std::vector<std::string>& images, const RenderFlow& flow)
{
    std::vector<std::string> files = with_checkpoint(images, flow);
    if (const std::string file = checkpoint_of(flow); !file.empty())
        files.push_back(previous_generation(file).string());
    return files;
}

// What to do after a signal.
void log_interruption(const RenderFlow& flow, const SampleSet::Range& samples)
{
    const bool can_go_on = !checkpoint_of(flow).empty();
    print_log(fmt::format("interrupted with {} to {} samples per pixel; {}", samples.least, samples.most,
                          can_go_on ? "to resume:" : "cannot be resumed without --checkpoint"));
    if (can_go_on) print_log("    renderer" + flow.typed + (flow.resume ? "" : " --resume"));
}

void log_message(const Diagnostic& message, bool quiet)
{
    if (message.severity == Severity::note) {
        if (!quiet) print_log(message.message);
    } else {
        print_log(message);
    }
}

TerminalFrame frame_of(const Preview& preview, const LiveOptions& options)
{
    const auto variable = [](const char* name) -> const char* { return std::getenv(name); };
    return {preview, options.graphics.value_or(terminal_graphics(variable)), has_true_color(variable)};
}

} // namespace

void check_flow(const RenderFlow& flow)
{
    // Hours of work are not to be written over.
    if (const std::string file = checkpoint_of(flow); !file.empty() && !flow.resume)
        if (const auto there = generation_there(file))
            throw Error(fmt::format("'{}' already exists; pass --resume to continue it, or remove it",
                                    there->string()));
    check_outputs(files_written(flow.session.part ? std::vector<std::string>() : flow.outputs, flow),
                  flow.json);
}

int run_flow(const RenderTask& task, const RenderFlow& flow)
{
    const Stopwatch since_loaded;
    const std::vector<std::string> images = images_of(flow, task);
    const std::vector<std::string> written = files_written(images, flow);
    if (flow.outputs.empty()) check_outputs(written, flow.json);
    KeptFiles(paths_of(task.scene.inputs))
        .refuse(with_json(written, flow.json), "the scene reads this file; write to another");

    check_denoising(images, task.settings.output);
    const bool has_checkpoint = !checkpoint_of(flow).empty();
    std::optional<InterruptGuard> guard(std::in_place,
                                        has_checkpoint ? Interruption::by_manager : Interruption::by_hand);
    std::optional<LiveOutput> live;
    std::optional<TerminalFrame> frame;
    std::optional<ProgressDisplay> display;
    const auto print_message = [&](const Diagnostic& message) {
        if (display) display->make_way();
        log_message(message, flow.quiet);
    };
    const auto warn_of_viewer = [&] {
        if (const auto problem = live ? live->take_problem() : std::nullopt)
            print_message({Severity::warning, {}, *problem});
    };
    SessionCallbacks callbacks{
        .progress = {}, .tile = {}, .message = print_message, .stop = &InterruptGuard::flag()};
    callbacks.progress = [&](const Progress& progress) {
        warn_of_viewer();
        display->show(progress);
    };
    if (flow.live.any())
        callbacks.tile = [&](const Film& film, const PixelRect& part) { live->show(film, part); };
    RenderSession session(task, flow.session, callbacks);
    if (flow.resume) session.resume();
    if (flow.live.any()) live.emplace(flow.live, task, session.state());
    if (live && live->preview()) frame.emplace(frame_of(*live->preview(), flow.live));
    warn_of_viewer();
    display.emplace(flow.quiet, frame ? &*frame : nullptr);
    const int signal = session.run() == StopReason::interrupted ? InterruptGuard::signal() : 0;
    display.reset();
    warn_of_viewer();
    live.reset();
    if (!has_checkpoint) guard.reset(); // else until it is written

    // Whoever sends a signal does not wait long: checkpoint and images are written at the same time.
    const Stopwatch writing;
    // In another thread if there is one to be had.
    std::future<void> saving = std::async(std::launch::async | std::launch::deferred, [&] {
        if (has_checkpoint) session.save();
    });
    Report report = make_report(session, session.evidence());
    report.outputs = with_checkpoint(images, flow);
    std::vector<std::string> problems;
    try {
        if (!images.empty())
            write_images(images, session.image(report.evidence), task.settings.output,
                         packing_of(report.evidence), flow.session.checkpoint.file.parent_path());
    } catch (const Error& error) {
        problems.emplace_back(error.what());
    }
    try {
        saving.get();
    } catch (const Error& error) {
        problems.emplace(problems.begin(), error.what());
    }
    if (!problems.empty()) throw Error(list_text(problems));

    report.write_seconds = writing.seconds();
    report.total_seconds = task.scene.parse_seconds + task.scene.build_seconds + since_loaded.seconds();
    note_machine(report);
    if (!flow.json.empty()) write_json(flow.json, report_json(report));
    if (!flow.quiet)
        for (const std::string& line : summary_of(report, task)) print_log(line);
    if (signal == 0) return exit_code::done;
    log_interruption(flow, session.state().taken.samples_per_pixel(session.state().film.window()));
    return exit_code::signal + signal;
}

} // namespace plumb
