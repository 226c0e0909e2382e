// SPDX-License-Identifier: MIT
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/header.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/text.h"
#include "cli/text_file.h"

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

// The same for every name of a file; empty if there is none.
std::filesystem::path identity(const std::filesystem::path& file)
{
    std::error_code failed;
    const auto path = std::filesystem::weakly_canonical(std::filesystem::absolute(file, failed), failed);
    return failed ? std::filesystem::path() : path;
}

// Two names of one file that only the file system knows to be one are a usage error, too.
void check_outputs(const std::vector<std::string>& outputs, const std::string& json)
{
    std::vector<std::string> files = outputs;
    for (const std::string& output : outputs) check_image_path(output);
    if (!json.empty() && json != "-") {
        check_text_path(json);
        files.push_back(json);
    }
    std::vector<std::filesystem::path> seen;
    for (const std::string& file : files) {
        const std::filesystem::path path = identity(file);
        if (path.empty()) continue;
        if (std::find(seen.begin(), seen.end(), path) != seen.end())
            throw UsageError(fmt::format("'{}' is to be written twice", file));
        seen.push_back(path);
    }
}

// What the scene was read from is not overwritten.
void keep_inputs(const std::vector<InputFile>& inputs, std::vector<std::string> outputs,
                 const std::string& json)
{
    if (!json.empty() && json != "-") outputs.push_back(json);
    for (const std::string& output : outputs)
        for (const InputFile& input : inputs)
            if (const auto path = identity(output); !path.empty() && path == identity(input.path))
                throw Error(
                    fmt::format("cannot write '{}': the scene reads this file; write to another", output));
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

void write_report(const Report& report, const std::string& file)
{
    if (file.empty()) return;
    if (file == "-")
        print_output(report_json(report));
    else
        write_text_file(file, report_json(report));
}

void log_summary(const Report& report, const Options& options, std::uint64_t samples)
{
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

} // namespace

void render_command(const Options& options)
{
    check_outputs(options.outputs, options.json);
    render_and_write(options, load_and_log(options));
}

void render_and_write(const Options& options, const LoadedScene& scene)
{
    const Stopwatch since_loaded;
    const bool default_names = options.outputs.empty();
    const std::vector<std::string> outputs =
        default_names ? default_outputs(options, scene) : options.outputs;
    if (default_names) check_outputs(outputs, options.json);
    keep_inputs(scene.inputs, outputs, options.json);

    const RenderResult result = [&] {
        ProgressDisplay display(options.quiet);
        return render(scene.job, options.render, [&](const Progress& progress) { display.show(progress); });
    }();

    const Stopwatch writing;
    Image image = result.film.develop(options.variance ? Channels::color_and_evidence : Channels::color);
    image.metadata = image_header(options, scene, result);
    write_images(outputs, image, options.exposure);

    Report report = make_report(options, scene, result);
    report.outputs = outputs;
    report.write_seconds = writing.seconds();
    report.total_seconds = scene.parse_seconds + scene.build_seconds + since_loaded.seconds();
    note_machine(report);
    write_report(report, options.json);
    const PixelRect& window = result.film.window();
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(window.width) * static_cast<std::uint64_t>(window.height);
    if (!options.quiet) log_summary(report, options, pixels * report.samples_per_pixel);
}

} // namespace plumb
