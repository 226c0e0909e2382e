// SPDX-License-Identifier: MIT
#include "base/parallel.h"
#include "plumb/base/hash.h"
#include "plumb/image/image.h"
#include "plumb/scene/scene.h"
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

#include <algorithm>
#include <chrono>
#include <future>
#include <utility>

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
        files[i].is_jpeg = i >= first && is_jpeg(read[i - first]);
    });
    return files;
}

// Of the bytes of every file, and of what settings and dialect make of them.
std::string input_hash(const std::vector<InputFile>& files, const Dialect& dialect,
                       const SceneSettings& settings, const MethodSettings& method, const ViewSettings& view)
{
    std::string all;
    const auto add = [&all](std::string_view text) { all += fmt::format("{}:{}", text.size(), text); };
    for (const InputFile& file : files) add(file.hash);
    for (const auto& [name, value] : settings.definitions) add(fmt::format("{}={}", name, value));
    add(method.integrator.value_or(""));
    add(method.sampler.value_or(""));
    if (view.size) add(fmt::format("{}x{}", view.size->x, view.size->y));
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
    std::vector<Diagnostic> all = in_file_order(diagnostics.all(), files);
    const auto names_the_option = [](const Diagnostic& one) {
        return one.message.find("--lenient") != std::string::npos;
    };
    if (diagnostics.has_only_unsupported() && std::none_of(all.begin(), all.end(), names_the_option))
        all.push_back(
            {Severity::note, {}, "--lenient leaves out what is not supported, with a warning for each"});
    throw SceneError(std::move(all));
}

} // namespace

struct SceneFile::Impl {
    Impl(const std::filesystem::path& path, SceneSettings scene_settings)
        : settings(std::move(scene_settings)),
          expansion(read(path)),
          wishes{settings.dialect, settings.emitters_absorb, settings.mirrored_view,
                 settings.environment_scale},
          choice(is_mitsuba ? mitsuba_choice(expansion.root, wishes, diagnostics)
                            : choose_dialect(expansion.root, wishes, diagnostics)),
          root(arranged()),
          context{diagnostics, choice.dialect, settings.lenient, {}, 0, nullptr, 0, words},
          builder(root, context)
    {
        of_tree = diagnostics;
        shared_texture_bytes = context.texture_bytes;
        seconds = seconds_since(start);
    }

    // The text becomes one tree.
    Expansion read(const std::filesystem::path& path)
    {
        auto document = parse_document(path, read_text(path), diagnostics);
        if (!document || !check_root(*document, diagnostics)) fail(diagnostics, {});
        const Definitions definitions(settings.definitions.begin(), settings.definitions.end());
        is_mitsuba = is_mitsuba_scene(*document);
        if (!is_mitsuba && !document->attribute("dialect"))
            std::erase_if(document->attributes, [](const Attribute& a) { return a.name == "version"; });
        return is_mitsuba ? expand_mitsuba(*std::move(document), definitions, diagnostics)
                          : expand(*std::move(document), definitions, diagnostics);
    }

    // In our own words.
    Element arranged()
    {
        words = is_mitsuba ? mitsuba_vocabulary(expansion.root, diagnostics)
                           : &nori_vocabulary(choice.dialect.name);
        if (!words) fail(diagnostics, expansion.files);
        const Readings readings(choice.dialect, wishes);
        return arrange(std::move(expansion.root), *words,
                       {.overrides = readings.presets(),
                        .lenient = settings.lenient,
                        .unset = choice.evidence.has_value()},
                       diagnostics);
    }

    const Clock::time_point start = Clock::now();
    const SceneSettings settings;
    Diagnostics diagnostics; // between calls of load(): of the tree, and of the scene if there is one
    bool is_mitsuba = false;
    const Vocabulary* words = nullptr;
    Expansion expansion; // its root only until it is arranged
    const DialectWishes wishes;
    const DialectChoice choice;
    const Element root;
    LoadContext context;
    SceneBuilder builder;
    Diagnostics of_tree;
    std::uint64_t shared_texture_bytes = 0;
    double seconds = 0.0; // of reading the tree, until the first load() has told
    std::shared_ptr<const Scene> scene;
    std::vector<InputFile> inputs; // of the scene
};

SceneFile::SceneFile(const std::filesystem::path& path, const SceneSettings& settings)
    : path_(path), impl_(std::make_unique<Impl>(path, settings))
{}

SceneFile::~SceneFile() = default;

const SceneSettings& SceneFile::settings() const
{
    return impl_->settings;
}

LoadedScene SceneFile::load(const MethodSettings& method, const ViewSettings& view)
{
    Impl& file = *impl_;
    Diagnostics& diagnostics = file.diagnostics;
    const Diagnostics before = diagnostics;
    try {
        return load_with(method, view);
    } catch (...) {
        diagnostics = before;
        throw;
    }
}

LoadedScene SceneFile::load_with(const MethodSettings& method, const ViewSettings& view)
{
    const auto start = Clock::now();
    Impl& file = *impl_;
    Diagnostics& diagnostics = file.diagnostics;

    // The tree becomes objects.
    const bool is_new = !file.scene || file.scene->options().instruction_set != method.instruction_set;
    SceneContents contents;
    if (is_new) {
        diagnostics = file.of_tree;
        file.context.texture_bytes = file.shared_texture_bytes;
        contents = file.builder.build_contents();
    }
    const Diagnostics of_scene = diagnostics;
    MethodAndView parts = file.builder.build_method_and_view(method, view);
    if (diagnostics.has_errors()) fail(diagnostics, file.expansion.files);
    // Meanwhile; in another thread if there is one to be had.
    std::future<std::vector<InputFile>> inputs_read;
    if (file.inputs.empty())
        inputs_read =
            std::async(std::launch::async | std::launch::deferred,
                       [&file, files = file.context.files] { return input_files(file.expansion, files); });
    const double parse_seconds = std::exchange(file.seconds, 0.0) + seconds_since(start);

    // The objects become a scene.
    const auto build_start = Clock::now();
    std::string integrator = std::move(parts.integrator_type);
    std::string sampler = std::move(parts.sampler_type);
    if (is_new) file.scene = make_scene(std::move(contents), method.instruction_set, file.choice.dialect);
    std::optional<RenderJob> job = assemble(file.scene, std::move(parts), file.context);
    if (inputs_read.valid()) file.inputs = inputs_read.get();
    if (!job) fail(std::exchange(diagnostics, of_scene), file.expansion.files);
    warn_of_open_readings(file.root, file.choice, file.wishes, job->scene.get(), diagnostics);
    warn_of_idle_suns(file.root, *job, file.choice.dialect, diagnostics);
    const Diagnostics all = std::exchange(diagnostics, of_scene);
    return {.job = *std::move(job),
            .dialect = file.choice.dialect,
            .integrator = std::move(integrator),
            .sampler = std::move(sampler),
            .aovs = file.builder.aovs(),
            .inputs = file.inputs,
            .input_hash = input_hash(file.inputs, file.choice.dialect, file.settings, method, view),
            .changed_readings = readings_changed_since_1(file.root, file.choice.dialect),
            .texture_bytes = file.context.texture_bytes,
            .warnings = in_file_order(all.all(), file.expansion.files),
            .parse_seconds = parse_seconds,
            .build_seconds = seconds_since(build_start)};
}

LoadedScene load_scene(const std::filesystem::path& path, const RenderSettings& settings)
{
    return SceneFile(path, settings.scene).load(settings.method, settings.view);
}

} // namespace plumb
