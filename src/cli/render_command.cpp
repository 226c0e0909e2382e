// SPDX-License-Identifier: MIT
#include "cli/checkpoint.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/header.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/render_run.h"
#include "cli/report.h"
#include "cli/text.h"

#include <chrono>
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

std::vector<std::string> default_outputs(const RenderRequest& request, const LoadedScene& scene)
{
    const std::string stem = std::filesystem::path(request.scene).stem().string();
    const bool fixed = request.settings.samples.per_pixel ||
                       !(request.settings.stop.seconds || request.settings.stop.relative_error);
    const std::string name =
        fixed ? fmt::format("{}_{}", stem,
                            render_samples(scene.job, render_options(request.settings, request.threads)))
              : stem;
    return {name + ".exr", name + ".png"};
}

void log_summary(const Report& report, const RenderRequest& request)
{
    const Evidence& evidence = report.evidence;
    print_log(fmt::format("{}: {} samples in {}, {}", list_text(report.outputs),
                          count_text(evidence.taken.count()), duration_text(report.render_seconds),
                          rate_text(report.rays.total(), report.render_seconds)));
    if (const auto& noise = evidence.noise)
        print_log(fmt::format("noise: rmse {}{:.3g} (95 % interval {:.3g} to {:.3g})",
                              report.noise_is_bound ? "at most " : "", noise->rmse, noise->low, noise->high));
    if (!evidence.ledger.biases.empty())
        print_log(fmt::format("biased: {}", list_text(evidence.ledger.biases)));
    if (report.is_black && report.lights > 0 && evidence.taken.count() > 0)
        print_log(
            fmt::format("warning: the image is black, although there {}; 'renderer check {}' may say why",
                        report.lights == 1 ? "is a light" : fmt::format("are {} lights", report.lights),
                        shell_quote(request.scene)));
    if (evidence.left_out.count == 0) return;
    const LeftOut::Sample& first = evidence.left_out.first;
    print_log(fmt::format("warning: {} samples were discarded, the first is {}; to see its path:",
                          evidence.left_out.count, left_out_text(first)));
    print_log(fmt::format("    renderer replay {} --pixel {},{} --sample {}{}", shell_quote(request.scene),
                          first.pixel.x, first.pixel.y, first.index, replay_options_text(request.settings)));
}

// What to do after a signal.
void log_interruption(const RenderRequest& request, const SampleSet::Range& samples)
{
    const bool can_go_on = !request.checkpoint.file.empty();
    print_log(fmt::format("interrupted with {} to {} samples per pixel; {}", samples.least, samples.most,
                          can_go_on ? "to resume:" : "cannot be resumed without --checkpoint"));
    if (can_go_on) print_log("    renderer" + request.typed + (request.checkpoint.resume ? "" : " --resume"));
}

std::vector<std::string> images_of(const RenderRequest& request, const LoadedScene& scene)
{
    if (request.part) return {};
    return request.outputs.empty() ? default_outputs(request, scene) : request.outputs;
}

std::vector<std::string> with_checkpoint(std::vector<std::string> images, const RenderRequest& request)
{
    if (!request.checkpoint.file.empty()) images.push_back(request.checkpoint.file);
    return images;
}

// Hours of work are not to be written over.
void keep_checkpoint(const RenderRequest& request)
{
    const std::string& file = request.checkpoint.file;
    if (file.empty() || request.checkpoint.resume) return;
    if (const auto there = generation_there(file))
        throw Error(
            fmt::format("'{}' already exists; pass --resume to continue it, or remove it", there->string()));
}

// All that a run writes to.
std::vector<std::string> files_written(const std::vector<std::string>& images, const RenderRequest& request)
{
    std::vector<std::string> files = with_checkpoint(images, request);
    if (!request.checkpoint.file.empty())
        files.push_back(previous_generation(request.checkpoint.file).string());
    return files;
}

// The picture of a run with its evidence, into all files.
void write_pictures_of(const RenderRun& run, const Evidence& evidence, const RenderRequest& request,
                       const std::vector<std::string>& files, const Metadata& header)
{
    Image image = run.state.film.develop(request.settings.output.error_bars ? Channels::color_and_evidence
                                                                            : Channels::color);
    image.metadata = header;
    const Metadata rest = evidence_header(evidence);
    image.metadata.insert(image.metadata.end(), rest.begin(), rest.end());
    write_pictures(files, image, request.settings.output.exposure, packing_of(evidence),
                   std::filesystem::path(request.checkpoint.file).parent_path());
}

} // namespace

int render_command(const RenderRequest& request)
{
    keep_checkpoint(request);
    check_outputs(files_written(request.part ? std::vector<std::string>() : request.outputs, request),
                  request.json);
    return log_rendering(request, render_and_write(request, load_and_log(request)));
}

Rendered render_and_write(const RenderRequest& request, const LoadedScene& scene)
{
    const Stopwatch since_loaded;
    const std::vector<std::string> images = images_of(request, scene);
    const std::vector<std::string> outputs = with_checkpoint(images, request);
    const std::vector<std::string> written = files_written(images, request);
    if (request.outputs.empty()) check_outputs(written, request.json);
    refuse_overwriting_inputs(KeptFiles(paths_of(scene.inputs)), written, request.json,
                              "the scene reads this file; write to another");

    const Metadata header = scene_header(request, scene);
    const Metadata work = work_header(request, scene);
    const bool has_checkpoint = !request.checkpoint.file.empty();
    std::optional<InterruptGuard> guard(std::in_place,
                                        has_checkpoint ? Interruption::by_manager : Interruption::by_hand);
    const RenderRun run = run_rendering(request, scene, work);
    if (!has_checkpoint) guard.reset(); // else until it is written

    // Whoever sends a signal does not wait long: checkpoint and pictures are written at the same time.
    const Stopwatch writing;
    // In another thread if there is one to be had.
    std::future<void> saving = std::async(std::launch::async | std::launch::deferred, [&] {
        if (has_checkpoint) save_run(request, scene, run.state, run.stop, work);
    });
    Report report = make_report(request, scene, run.state,
                                make_evidence(make_ledger(scene.job, scene.dialect), run.state, run.stop));
    report.outputs = outputs;
    std::vector<std::string> problems;
    try {
        if (!images.empty() && (run.signal == 0 || request.keep_interrupted))
            write_pictures_of(run, report.evidence, request, images, header);
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
    report.total_seconds = scene.parse_seconds + scene.build_seconds + since_loaded.seconds();
    note_machine(report);
    if (!request.json.empty()) write_json(request.json, report_json(report));
    return {std::move(report), run.state.taken.samples_per_pixel(run.state.film.window()), run.signal};
}

int log_rendering(const RenderRequest& request, const Rendered& rendered)
{
    if (!request.quiet) log_summary(rendered.report, request);
    if (rendered.signal == 0) return exit_code::done;
    log_interruption(request, rendered.samples);
    return exit_code::signal + rendered.signal;
}

} // namespace plumb
