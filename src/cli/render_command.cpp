// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/header.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/text.h"

#include <chrono>
#include <fmt/format.h>

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

std::vector<std::string> default_outputs(const Options& options, const LoadedScene& scene)
{
    const std::string stem = std::filesystem::path(options.subject).stem().string();
    const std::string name = fmt::format("{}_{}", stem, scene.job.sampler->samples_per_pixel());
    return {name + ".exr", name + ".png"};
}

// A picture may have taken long: one that cannot be written does not keep the others from being tried.
void write_images(const std::vector<std::string>& outputs, const Image& image, float exposure)
{
    std::vector<std::string> problems;
    for (const std::string& output : outputs) {
        try {
            write_image(output, image, exposure);
        } catch (const Error& error) {
            problems.emplace_back(error.what());
        }
    }
    if (!problems.empty()) throw Error(list_text(problems));
}

} // namespace

int render_command(const Options& options)
{
    check_outputs(options.outputs, options.json);
    log_rendering(options, render_and_write(options, load_and_log(options)));
    return exit_code::done;
}

Report render_and_write(const Options& options, const LoadedScene& scene)
{
    const Stopwatch since_loaded;
    const bool default_names = options.outputs.empty();
    const std::vector<std::string> outputs =
        default_names ? default_outputs(options, scene) : options.outputs;
    if (default_names) check_outputs(outputs, options.json);
    keep_inputs(paths_of(scene.inputs), outputs, options.json, "the scene reads this file; write to another");

    const RenderResult result = [&] {
        ProgressDisplay display(options.quiet);
        return render(scene.job, options.render, [&](const Progress& progress) { display.show(progress); });
    }();

    const Stopwatch writing;
    Image image = result.film.develop(options.variance ? Channels::color_and_evidence : Channels::color);
    Report report = make_report(options, scene, result);
    report.outputs = outputs;
    image.metadata = image_header(options, scene, report);
    write_images(outputs, image, options.exposure);

    report.write_seconds = writing.seconds();
    report.total_seconds = scene.parse_seconds + scene.build_seconds + since_loaded.seconds();
    note_machine(report);
    if (!options.json.empty()) write_json(options.json, report_json(report));
    return report;
}

void log_rendering(const Options& options, const Report& report)
{
    if (options.quiet) return;
    const Vec2i size = report.crop ? Vec2i(report.crop->width, report.crop->height) : report.resolution;
    const std::uint64_t samples =
        static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) * report.samples_per_pixel;
    print_log(fmt::format("{}: {} samples in {}, {}", list_text(report.outputs), count_text(samples),
                          duration_text(report.render_seconds),
                          rate_text(report.rays.total(), report.render_seconds)));
    if (report.noise)
        print_log(fmt::format("noise: rmse {:.3g} (95 % interval {:.3g} to {:.3g})", report.noise->rmse,
                              report.noise->low, report.noise->high));
    if (!report.ledger.biases.empty()) print_log(fmt::format("biased: {}", list_text(report.ledger.biases)));
    if (report.left_out.count == 0) return;
    const LeftOut::Sample& first = report.left_out.first;
    print_log(fmt::format("warning: {} samples were left out, the first is {}; to see its path:\n"
                          "    renderer replay {} --pixel {},{} --sample {}{}",
                          report.left_out.count, left_out_text(first), shell_quote(options.subject),
                          first.pixel.x, first.pixel.y, first.index, options.scene_words));
}

} // namespace plumb
