// SPDX-License-Identifier: MIT

// The references of a suite: making them, and whether they are what Plumb would make today.

#include "experiments/suite_runner.h"

#include "base/shell_words.h"
#include "base/text_file.h"
#include "plumb/base/hash.h"
#include "plumb/image/development.h"
#include "rendering/origin.h"
#include "rendering/provenance.h"
#include "settings/options_text.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

namespace fs = std::filesystem;

// Of an image that Plumb has made; nothing: it is another program's, or its header cannot be understood.
std::optional<RenderSettings> settings_of_image(const Image& image, const std::string& file)
{
    if (header_text(image.metadata, "plumb:inputs").empty() || has_old_hashes(image.metadata)) return {};
    try {
        return header_settings(image.metadata, file);
    } catch (const Error&) {
        return {};
    }
}

// Of the files, of what they mean and of the program. Another processor does not make a reference stale.
std::vector<std::string> changes_since(const Metadata& then, const Metadata& now)
{
    std::vector<std::string> changes = input_changes(then, now);
    if (changes.empty() && header_text(then, "plumb:inputHash") != header_text(now, "plumb:inputHash"))
        changes.emplace_back("the scene's settings or dialect mean something else");
    if (const std::string was = header_text(then, "Software"), is = header_text(now, "Software"); was != is)
        changes.push_back(fmt::format("the program was {} and is {}", was, is));
    return changes;
}

bool has_same_pixels(const Image& a, const Image& b)
{
    if (a.data_window() != b.data_window() || a.channel_count() != b.channel_count()) return false;
    std::vector<std::ptrdiff_t> places; // in b, of the channels of a: a file may have them in another order
    for (const std::string& name : a.channel_names()) {
        const auto& names = b.channel_names();
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end()) return false;
        places.push_back(found - names.begin());
    }
    const PixelRect& window = a.data_window();
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            for (int i = 0; i < a.channel_count(); ++i) {
                const float p = a.pixel(x, y)[i], q = b.pixel(x, y)[places[static_cast<std::size_t>(i)]];
                if (p != q && (p == p || q == q)) return false;
            }
    return true;
}

} // namespace

void SuiteRunner::make_reference(const SuiteJob& job, SuiteResult& result)
{
    const fs::path& reference = job.entry.reference;
    std::vector<std::string> files = {reference.string()};
    if (reference.extension() == ".exr")
        files.push_back(fs::path(reference).replace_extension(".png").string());
    if (const std::string how = development_text(job.reference.output.development);
        is_low_dynamic_range(reference) && (!how.empty() || job.reference.output.denoise))
        throw Error(fmt::format("'{}' cannot be made with '{}': a reference has the values of light; make an "
                                ".exr file, or take these settings out of the suite",
                                reference.string(), job.reference.output.denoise ? "denoise" : how));
    const RenderTask task = task_of(job.entry, job.reference);
    for (const Diagnostic& warning : task.scene.warnings) result.warnings.push_back(warning.text());
    make_directory(reference.parent_path());
    kept_.refuse(files, "it is a scene of the suite");
    for (const std::string& file : files) check_image_path(file);

    std::optional<Image> before;
    std::error_code problem;
    if (fs::exists(reference, problem)) {
        const std::string hash = sha256_of_file(reference).substr(0, 8);
        const fs::path kept =
            options_.directory / "replaced" /
            fmt::format("{}_{}{}", reference.stem().string(), hash, reference.extension().string());
        make_directory(kept.parent_path());
        fs::copy_file(reference, kept, fs::copy_options::overwrite_existing, problem);
        if (problem)
            throw Error(fmt::format("cannot keep the old '{}' as '{}': {}", reference.string(), kept.string(),
                                    problem.message()));
        result.replaced = kept.string();
        try {
            before = read_to_compare(reference);
        } catch (const Error& error) {
            result.warnings.push_back(fmt::format("the old reference: {}", error.what()));
        }
    }
    Made made = render_whole(task, files, result);
    if (made.evidence.noise) result.noise = made.evidence.noise->rmse;
    result.left_out = made.evidence.left_out.count;
    result.state = JobState::made;
    result.image = reference.string();
    if (!before) return;
    result.accept_command =
        fmt::format("cp {} {}", shell_quote(result.replaced), shell_quote(reference.string()));
    result.reference = result.replaced;
    compare_references(job, std::move(made.image), std::move(*before), result);
}

// A: what is made now. B: what was there.
void SuiteRunner::compare_references(const SuiteJob& job, Image now, Image before, SuiteResult& result)
{
    image_ = std::move(now);
    reference_ = std::move(before);
    result.how = job.compare;
    result.how.exact.reset();
    if (!result.replaced.empty())
        result.compare_command = "renderer compare " + shell_quote(result.image) + " " +
                                 shell_quote(result.replaced) + options_text(result.how);
    try {
        result.comparison = compare(*image_, *reference_, result.how);
    } catch (const Error& error) {
        result.warnings.push_back(
            fmt::format("the old and the new reference cannot be compared: {}", error.what()));
        return;
    }
    const std::string stem = stem_of("references/" + fs::path(job.entry.reference).stem().string());
    make_directory(fs::path(stem).parent_path());
    write_maps(*image_, *reference_, stem, result);
}

void SuiteRunner::check_reference(const SuiteJob& job, SuiteResult& result)
{
    const std::string file = job.entry.reference.string();
    Image before = read_to_compare(file);
    const std::optional<RenderSettings> settings = settings_of_image(before, file);
    if (!settings) throw Error(fmt::format("the header of '{}' does not say how Plumb makes it", file));
    result.command = command_text(job.entry.scene, *settings);
    note_stale(job, before, result);
    const RenderTask task = task_of(job.entry, *settings);
    Made made = render_whole(task, {}, result);
    const bool is_same = has_same_pixels(made.image, before);
    result.image = file;
    result.state = JobState::compared;
    compare_references(job, std::move(made.image), std::move(before), result);
    result.verdict = is_same ? Verdict::passes : Verdict::differs;
    if (is_same) return;
    result.stale.emplace_back("its pixels are not those that its header's command gives today");
    result.accept_command = suite_command(" --update=" + shell_quote(file));
}

const SuiteJob* SuiteRunner::maker_of(const SuiteJob& job) const
{
    for (const SuiteJob& one : jobs_)
        if (one.entry.reference == job.entry.reference && !one.entry.scene.empty()) return &one;
    return nullptr;
}

void SuiteRunner::note_stale(const SuiteJob& job, const Image& reference, SuiteResult& result)
{
    const SuiteJob* const maker = maker_of(job);
    if (!maker) return;
    const auto known = stale_.find(job.entry.reference);
    result.stale =
        known != stale_.end()
            ? known->second
            : stale_.emplace(job.entry.reference, stale_reasons(*maker, reference, result)).first->second;
}

// Without rendering: what its header tells of program, files and settings.
std::vector<std::string> SuiteRunner::stale_reasons(const SuiteJob& maker, const Image& reference,
                                                    SuiteResult& result)
{
    const std::string file = maker.entry.reference.string();
    const std::optional<RenderSettings> settings = settings_of_image(reference, file);
    if (!settings) return {};
    try {
        const RenderTask task = task_of(maker.entry, *settings);
        return changes_since(reference.metadata, scene_header(task));
    } catch (const Error& error) {
        result.warnings.push_back(
            fmt::format("whether '{}' is stale cannot be said: {}", file, error.what()));
        return {};
    }
}

} // namespace plumb
