// SPDX-License-Identifier: MIT
#include "rendering/origin.h"

#include "base/shell_words.h"
#include "base/text.h"
#include "base/visible_text.h"
#include "render/sample_text.h"
#include "rendering/program.h"

#include "plumb/render/aovs.h"
#include "plumb/rendering/task.h"
#include "plumb/scene/scene.h"
#include "plumb/settings/settings_header.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

namespace plumb {

namespace {

std::vector<float> world_to_camera(const Camera& camera)
{
    const Transform inverse = camera.to_world().inverse();
    std::vector<float> matrix;
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            matrix.push_back(static_cast<float>(inverse.rows()[row][column]));
    return matrix;
}

std::string processor_maker()
{
#if defined(__x86_64__) || defined(__i386__)
    unsigned int ignored = 0;
    unsigned int name[3] = {};
    __get_cpuid(0, &ignored, &name[0], &name[2], &name[1]);
    std::string maker(sizeof name, '\0');
    std::memcpy(maker.data(), name, sizeof name);
    return visible_text(maker);
#else
    return "unknown";
#endif
}

const char* on_off(bool on)
{
    return on ? "on" : "off";
}

} // namespace

std::string input_name(const std::filesystem::path& input, const std::filesystem::path& scene_file)
{
    const std::filesystem::path from_scene = input.lexically_normal().lexically_relative(
        scene_file.lexically_normal().parent_path().empty() ? "."
                                                            : scene_file.lexically_normal().parent_path());
    const bool inside = !from_scene.empty() && !from_scene.is_absolute();
    return valid_utf8((inside ? from_scene : input.filename()).generic_string());
}

Metadata scene_header(const RenderTask& task)
{
    const LoadedScene& scene = task.scene;
    const RenderSettings& settings = task.settings;
    Metadata header;
    const auto add = [&](const char* name, MetadataValue value) {
        header.emplace_back(name, std::move(value));
    };
    add("Software", "Plumb " PLUMB_VERSION);
    add("plumb:scene", task.name);
    for (Metadata::value_type& entry : settings_header(settings)) header.push_back(std::move(entry));
    std::string inputs;
    for (const InputFile& input : scene.inputs)
        inputs += (inputs.empty() ? "" : "\n") + input.hash + " " + input_name(input.path, task.file);
    add("plumb:inputs", inputs);
    add("plumb:inputHash", scene.input_hash);
    if (!settings.scene.definitions.empty()) {
        std::string definitions;
        for (const auto& [name, value] : settings.scene.definitions)
            definitions += (definitions.empty() ? "" : " ") + shell_quote(name + "=" + value);
        add("plumb:definitions", valid_utf8(definitions));
    }
    add("plumb:integrator", scene.integrator);
    add("plumb:sampler", scene.sampler);
    if (scene.job.sampler->depends_on_total())
        add("plumb:samplerTotal", static_cast<int>(task.options.samples_per_pixel));
    if (!scene.job.sampler->is_independent()) add("plumb:errorBars", "upper bounds");
    if (task.options.adaptive) add("plumb:adaptive", fmt::format("{}", *task.options.adaptive));
    add("plumb:seed", std::to_string(settings.samples.seed));
    add("plumb:language", language_version);
    add("plumb:dialect", std::string(to_string(scene.dialect.name)));
    add("plumb:dialectReason", valid_utf8(scene.dialect.reason));
    add("plumb:emitters", scene.dialect.emitters_absorb ? "absorb" : "scatter");
    add("plumb:mirror", on_off(scene.dialect.mirrored_view));
    add("plumb:point", scene.dialect.point_takes_power ? "power" : "radiance");
    add("plumb:envmapFlipped", on_off(scene.dialect.environment_flipped));
    add("plumb:envmapScale", scene.dialect.environment_scale);
    add("plumb:instructionSet", scene.job.scene->options().instruction_set);
    add("plumb:embree", scene.job.scene->embree_version());
    add("plumb:processor", processor_maker());
    const auto is_jpeg = [](const InputFile& input) { return input.is_jpeg; };
    if (std::any_of(scene.inputs.begin(), scene.inputs.end(), is_jpeg))
        add("plumb:jpegDecoder", jpeg_decoder());
    if (const auto lights = light_table(settings.view.splits, *scene.job.scene); !lights.empty())
        header.emplace_back("plumb:ids.light", valid_utf8(lines_text(lights)));
    for (auto& [name, ids] : id_tables(aovs_of(settings.view, scene), *scene.job.scene)) {
        for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = fmt::format("{} {}", i + 1, ids[i]);
        header.emplace_back("plumb:ids." + name, valid_utf8(lines_text(ids)));
    }
    add("worldToCamera", world_to_camera(*scene.job.camera));
    return header;
}

Metadata work_header(const RenderTask& task, const std::optional<PartSettings>& part)
{
    Metadata header = scene_header(task);
    const BiasReport ledger = make_ledger(task.scene.job, task.scene.dialect);
    if (!ledger.biases.empty()) header.emplace_back("plumb:workBiases", lines_text(ledger.biases));
    if (!ledger.model.empty()) header.emplace_back("plumb:workModel", lines_text(ledger.model));
    if (part) {
        header.emplace_back("plumb:workWanted", static_cast<int>(task.options.samples_per_pixel));
        header.emplace_back("plumb:workPart", fmt::format("{}/{} by {}", part->index + 1, part->count,
                                                          part->by == PartBy::tiles ? "tiles" : "samples"));
    }
    return header;
}

Metadata with_program(Metadata header)
{
    header.emplace_back("plumb:workProgram", hash_of_program());
    return header;
}

Metadata evidence_header(const Evidence& evidence)
{
    Metadata header;
    const auto add = [&](const char* name, MetadataValue value) {
        header.emplace_back(name, std::move(value));
    };
    add("plumb:samplesPerPixel", static_cast<int>(evidence.samples_per_pixel)); // at most 2^26
    if (evidence.most_samples_per_pixel)
        add("plumb:mostSamplesPerPixel", static_cast<int>(*evidence.most_samples_per_pixel));
    if (!evidence.even) add("plumb:samplesTaken", evidence.taken.text());
    if (!evidence.stop.empty()) add("plumb:stop", evidence.stop);
    const BiasReport& ledger = evidence.ledger;
    add("plumb:biased", ledger.biases.empty() ? 0 : 1);
    if (!ledger.biases.empty()) add("plumb:biases", list_text(ledger.biases));
    if (!ledger.model.empty()) add("plumb:model", list_text(ledger.model));
    if (const auto& noise = evidence.noise) {
        add("plumb:rmse", static_cast<float>(noise->rmse));
        add("plumb:rmseInterval",
            std::vector<float>{static_cast<float>(noise->low), static_cast<float>(noise->high)});
    }
    add("plumb:leftOut", std::to_string(evidence.left_out.count));
    if (evidence.left_out.count > 0) add("plumb:leftOutFirst", left_out_text(evidence.left_out.first));
    return header;
}

Image image_of(const Film& film, Metadata header, const Evidence& evidence, const OutputSettings& output)
{
    Image image = film.develop(output.error_bars ? Channels::color_and_evidence : Channels::color);
    image.metadata = std::move(header);
    const Metadata rest = evidence_header(evidence);
    image.metadata.insert(image.metadata.end(), rest.begin(), rest.end());
    return image;
}

} // namespace plumb
