// SPDX-License-Identifier: MIT

// The images of a suite: rendered, made by another program or there already, and compared with their references.

#include "experiments/suite_runner.h"

#include "base/shell_words.h"
#include "base/text.h"
#include "base/text_file.h"
#include "experiments/foreign_command.h"
#include "experiments/foreign_run.h"
#include "settings/options_text.h"

#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

void check_outputs(const std::vector<std::string>& files)
{
    for (const std::string& file : files) check_image_path(file);
    if (const auto twice = listed_twice(files))
        throw Error(fmt::format("'{}' is listed as an output twice", *twice));
}

std::string difference_of(const std::string& stem)
{
    return stem + "_diff.png";
}

std::string significant_of(const std::string& stem)
{
    return stem + "_significant.png";
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

// "A.exr B.exr", or the replicas and the reference behind them.
std::string compared_files(const SuiteResult& result)
{
    std::string text;
    if (result.replicas.empty()) return shell_quote(result.image) + " " + shell_quote(result.reference);
    for (const std::string& replica : result.replicas) text += shell_quote(replica) + " ";
    return text + "--against " + shell_quote(result.reference);
}

// The mean of the replicas, where there are several.
Image mean_of(std::vector<Image> replicas)
{
    return replicas.size() == 1 ? std::move(replicas.front()) : mean_of_replicas(replicas, Side::a);
}

// Its colours alone, for looking at: channels may have any names.
void write_screen_image(const std::string& file, const Image& image)
{
    const PixelRect& window = image.data_window();
    Image colours(window, image.full_width(), image.full_height());
    for (int y = window.y; y < window.y + window.height; ++y) {
        for (int x = window.x; x < window.x + window.width; ++x) {
            const Color color = image.color(x, y);
            for (int i = 0; i < 3; ++i) colours.pixel(x, y)[i] = color[i];
        }
    }
    write_image(file, colours);
}

} // namespace

// Makes the directories, and throws before anything is rendered if a file must not or cannot be written.
void SuiteRunner::prepare_outputs(const SuiteJob& job, const std::string& stem,
                                  std::vector<std::string> files) const
{
    make_directory(fs::path(stem).parent_path());
    if (!job.entry.reference.empty()) {
        files.push_back(difference_of(stem));
        files.push_back(significant_of(stem));
    }
    kept_.refuse(files, "it is a scene or a reference of the suite");
    check_outputs(files);
}

// The title with the number of samples that the scene asks for, which must be nobody else's.
std::string SuiteRunner::counted_title(const SuiteEntry& entry, const RenderTask& task)
{
    if (entry.settings.contains("spp")) return entry.title();
    std::string title = fmt::format("{}_{}", entry.name, task.options.samples_per_pixel);
    if (!titles_.insert(title).second)
        throw SceneError({Diagnostic{
            Severity::error, entry.at,
            fmt::format("another entry also writes '{}.exr'; give one of them another name", title)}});
    return title;
}

void SuiteRunner::make_image(const SuiteJob& job, SuiteResult& result)
{
    const RenderTask task = task_of(job.entry, job.image);
    for (const Diagnostic& warning : task.scene.warnings) result.warnings.push_back(warning.text());
    result.title = counted_title(job.entry, task);
    const std::string stem = stem_of(result.title);
    const std::vector<std::string> files = {stem + ".exr", stem + ".png"};
    const std::string key = image_key(task);
    result.up_to_date = !options_.force && state_.is_up_to_date(result.title, key, files);
    if (result.up_to_date) {
        image_ = read_image(files[0], true);
        read_header(result, *image_);
    } else {
        prepare_outputs(job, stem, files);
        Made made = render_whole(task, files, result);
        state_.note(result.title, key, files);
        note_evidence(result, made.evidence);
        image_ = std::move(made.image);
    }
    result.image = files[0];
    result.screen_image = files[1];
    result.state = JobState::rendered;
    compare_with_reference(job, result);
}

void SuiteRunner::run_program(const SuiteJob& job, SuiteResult& result)
{
    const ForeignImage& foreign = *job.entry.foreign;
    if (!options_.allow_commands)
        throw ProgramError(foreign.at, "this entry runs a command, which needs --allow-commands",
                           {.output = result.command});
    require_reference(job.entry);
    const ForeignJob work{request_of(job), stem_of(result.title), options_.threads, callbacks_.stop};
    const std::string key = foreign_key(work);
    std::vector<std::string> files = expected_images(work);
    result.up_to_date = !options_.force && state_.is_up_to_date(result.title, key, files);
    std::vector<Image> images;
    if (!result.up_to_date) {
        std::vector<std::string> outputs = files;
        outputs.push_back(work.stem + ".png");
        prepare_outputs(job, work.stem, outputs);
        try {
            ForeignImages made = run_command(work);
            files = std::move(made.files);
            images = std::move(made.images);
            result.program = std::move(made.run);
        } catch (const ProgramError&) {
            throw;
        } catch (const Error&) {
            result.interrupted = callbacks_.is_stopped();
            throw;
        }
        kept_.refuse(files, "it is a scene or a reference of the suite");
    }
    show_foreign(job, files, std::move(images), result);
    // What cannot be read is no result.
    if (!result.up_to_date) state_.note(result.title, key, files);
    compare_with_reference(job, result);
}

void SuiteRunner::take_image(const SuiteJob& job, SuiteResult& result)
{
    std::vector<std::string> files;
    for (const fs::path& file : given_images(request_of(job))) {
        std::error_code ignored;
        if (!fs::exists(file, ignored))
            throw SceneError({Diagnostic{Severity::error, job.entry.foreign->at,
                                         fmt::format("image '{}' does not exist", file.string())}});
        files.push_back(file.string());
    }
    prepare_outputs(job, stem_of(result.title), {stem_of(result.title) + ".png"});
    show_foreign(job, files, {}, result);
    compare_with_reference(job, result);
}

// images: what is in the files; empty: to be read.
void SuiteRunner::show_foreign(const SuiteJob& job, const std::vector<std::string>& files,
                               std::vector<Image> images, SuiteResult& result)
{
    try {
        if (images.empty())
            for (const std::string& file : files) images.push_back(read_to_compare(file));
        image_ = mean_of(std::move(images));
    } catch (const Error& error) {
        throw ProgramError(job.entry.foreign->at, error.what(), result.program.value_or(ProgramRun()));
    }
    result.image = files.front();
    if (files.size() > 1) result.replicas = files;
    result.screen_image = stem_of(result.title) + ".png";
    write_screen_image(result.screen_image, *image_);
    result.state = JobState::rendered;
}

void SuiteRunner::require_reference(const SuiteEntry& entry) const
{
    std::error_code ignored;
    if (entry.reference.empty() || fs::exists(entry.reference, ignored)) return;
    throw SceneError({Diagnostic{
        Severity::error, entry.reference_at,
        entry.scene.empty() ? fmt::format("reference '{}' does not exist, and no scene says how it is made",
                                          entry.reference.string())
                            : fmt::format("reference '{}' does not exist; '{}' makes it",
                                          entry.reference.string(), suite_command(" --update"))}});
}

void SuiteRunner::compare_with_reference(const SuiteJob& job, SuiteResult& result)
{
    const SuiteEntry& entry = job.entry;
    if (entry.reference.empty()) return;
    require_reference(entry);
    const Image& reference = reference_.emplace(read_to_compare(entry.reference));
    result.how = job.compare;
    result.compare_command = "renderer compare " + compared_files(result) + options_text(result.how);
    note_stale(job, reference, result);
    try {
        result.comparison = compare(*image_, reference, result.how);
    } catch (const Error& error) {
        throw Error(fmt::format("cannot compare A, '{}', with B, '{}': {}", result.image,
                                entry.reference.string(), error.what()));
    }
    result.state = JobState::compared;
    result.verdict = result.comparison->verdict;
    // A wrong image of another program, or of another scene, is no reason for another reference.
    const SuiteJob* const maker = maker_of(job);
    const bool is_of_maker = maker && !entry.foreign && maker->entry.scene == entry.scene &&
                             maker->entry.definitions == entry.definitions;
    if (!result.stale.empty() || (result.verdict == Verdict::differs && is_of_maker))
        result.accept_command = suite_command(" --update=" + shell_quote(entry.reference.string()));
    write_maps(*image_, reference, stem_of(result.title), result);
}

void SuiteRunner::write_maps(const Image& image, const Image& reference, const std::string& stem,
                             SuiteResult& result)
{
    result.difference = difference_of(stem);
    write_image(result.difference, difference_image(image, reference, result.how.layer));
    Significance& found = result.comparison->significance;
    if (!found.rejected_by.empty()) {
        result.significant = significant_of(stem);
        write_image(result.significant, significance_image(image, reference, *result.comparison, result.how));
    }
    // They would be kept for all images of the suite.
    found.rejected_by = {};
    result.comparison->flip_map = {};
}

} // namespace plumb
