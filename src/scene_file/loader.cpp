// SPDX-License-Identifier: MIT
#include "base/parallel.h"
#include "plumb/base/hash.h"
#include "plumb/scene_file/scene_file.h"
#include "scene_file/after_load.h"
#include "scene_file/build.h"
#include "scene_file/dialects.h"
#include "scene_file/expand.h"
#include "scene_file/file_order.h"
#include "scene_file/foreign_files.h"
#include "scene_file/mitsuba_expand.h"
#include "scene_file/mitsuba_words.h"
#include "scene_file/nori_words.h"

#include <chrono>
#include <future>

#include <fmt/format.h>

namespace plumb {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<InputFile> input_files(const Expansion& expansion, const std::vector<std::filesystem::path>& read)
{
    std::vector<InputFile> files;
    for (const auto& file : expansion.files) files.push_back({file->path(), {}});
    const std::size_t first = files.size();
    for (const std::filesystem::path& file : read) files.push_back({file, {}});
    parallel_for(files.size(), 0, [&](std::size_t i) {
        files[i].hash = i < first ? sha256(expansion.files[i]->text()) : sha256_of_file(read[i - first]);
    });
    return files;
}

// Of the bytes of every file, and of what the command line and the dialect make of them.
std::string input_hash(const std::vector<InputFile>& files, const Dialect& dialect,
                       const LoadOptions& options)
{
    std::string all;
    const auto add = [&all](std::string_view text) { all += fmt::format("{}:{}", text.size(), text); };
    for (const InputFile& file : files) add(file.hash);
    for (const auto& [name, value] : options.definitions) add(fmt::format("{}={}", name, value));
    add(options.integrator.value_or(""));
    add(options.sampler.value_or(""));
    if (options.resolution) add(fmt::format("{}x{}", options.resolution->x, options.resolution->y));
    add(fmt::format("{} {} {} {} {}", dialect.mirrored_view, dialect.emitters_absorb,
                    dialect.point_takes_power, dialect.environment_flipped, dialect.environment_scale));
    return sha256(all);
}

// The root element must be a <scene>, and of ours.
bool check_root(const Element& root, Diagnostics& diagnostics)
{
    if (is_mitsuba_scene(root)) return true;
    if (const auto foreign = foreign_scene(root)) {
        diagnostics.add(foreign->severity, foreign->location, foreign->message);
        return false;
    }
    if (root.tag == "scene") return true;
    diagnostics.error(root.place(),
                      root.tag == "test"
                          ? std::string("a <test> file is not a scene; 'renderer test FILE' runs it")
                          : fmt::format("the root of a scene file must be <scene>, not <{}>", root.tag));
    return false;
}

[[noreturn]] void fail(const Diagnostics& diagnostics,
                       const std::vector<std::shared_ptr<const TextFile>>& files)
{
    throw SceneError(in_file_order(diagnostics.all(), files));
}

} // namespace

LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options)
{
    const auto start = Clock::now();

    // The text becomes one tree.
    Diagnostics diagnostics;
    auto document = parse_document(path, read_text(path), diagnostics);
    if (!document || !check_root(*document, diagnostics)) fail(diagnostics, {});
    const Definitions definitions(options.definitions.begin(), options.definitions.end());
    const bool is_mitsuba = is_mitsuba_scene(*document);
    Expansion expansion = is_mitsuba ? expand_mitsuba(*std::move(document), definitions, diagnostics)
                                     : expand(*std::move(document), definitions, diagnostics);

    // The tree becomes objects.
    const DialectWishes wishes{options.dialect, options.emitters_absorb, options.mirrored_view,
                               options.environment_scale};
    const DialectChoice choice = is_mitsuba ? mitsuba_choice(expansion.root, wishes, diagnostics)
                                            : choose_dialect(expansion.root, wishes, diagnostics);
    const Dialect& dialect = choice.dialect;
    const Vocabulary* const words =
        is_mitsuba ? mitsuba_vocabulary(expansion.root, diagnostics) : &nori_vocabulary(dialect.name);
    if (!words) fail(diagnostics, expansion.files);
    const Readings readings(dialect, wishes);
    expansion.root = arrange(std::move(expansion.root), *words,
                             {.overrides = readings.presets(), .lenient = options.lenient}, diagnostics);
    LoadContext context{diagnostics, dialect, options.lenient, {}};
    context.vocabulary = words;
    SceneParts parts = build_scene(expansion.root, options, context);
    if (diagnostics.has_errors()) fail(diagnostics, expansion.files);
    // Meanwhile; in another thread if there is one to be had.
    std::future<std::vector<InputFile>> inputs_read =
        std::async(std::launch::async | std::launch::deferred,
                   [&expansion, files = context.files] { return input_files(expansion, files); });
    const double parse_seconds = seconds_since(start);

    // The objects become a scene.
    const auto build_start = Clock::now();
    std::string integrator = std::move(parts.integrator_type);
    std::string sampler = std::move(parts.sampler_type);
    std::optional<RenderJob> job = assemble(std::move(parts), options, context);
    std::vector<InputFile> inputs = inputs_read.get();
    if (!job) fail(diagnostics, expansion.files);
    warn_of_open_readings(expansion.root, choice, wishes, &job->scene, diagnostics);
    warn_of_idle_suns(expansion.root, *job, dialect, diagnostics);
    std::string hash = input_hash(inputs, dialect, options);
    return {.job = *std::move(job),
            .dialect = dialect,
            .integrator = std::move(integrator),
            .sampler = std::move(sampler),
            .inputs = std::move(inputs),
            .input_hash = std::move(hash),
            .changed_readings = readings_changed_since_1(expansion.root, dialect),
            .texture_bytes = context.texture_bytes,
            .warnings = in_file_order(diagnostics.all(), expansion.files),
            .parse_seconds = parse_seconds,
            .build_seconds = seconds_since(build_start)};
}

} // namespace plumb
