// SPDX-License-Identifier: MIT
#include "cli/header.h"

#include "cli/text.h"

#include <fmt/format.h>

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

const char* on_off(bool on)
{
    return on ? "on" : "off";
}

} // namespace

Metadata image_header(const Options& options, const LoadedScene& scene, const LeftOut& left_out)
{
    Metadata header;
    const auto add = [&](const char* name, MetadataValue value) {
        header.emplace_back(name, std::move(value));
    };
    add("Software", "Plumb " PLUMB_VERSION);
    add("plumb:scene", valid_utf8(std::filesystem::path(options.subject).filename().string()));
    add("plumb:inputHash", scene.input_hash);
    if (!options.load.definitions.empty()) {
        std::string definitions;
        for (const auto& [name, value] : options.load.definitions)
            definitions += (definitions.empty() ? "" : " ") + shell_quote(name + "=" + value);
        add("plumb:definitions", valid_utf8(definitions));
    }
    add("plumb:integrator", scene.integrator);
    add("plumb:sampler", scene.sampler);
    add("plumb:samplesPerPixel", static_cast<int>(scene.job.sampler->samples_per_pixel())); // at most 2^26
    add("plumb:seed", std::to_string(options.render.seed));
    add("plumb:dialect", std::string(to_string(scene.dialect.name)));
    add("plumb:dialectReason", valid_utf8(scene.dialect.reason));
    add("plumb:emitters", scene.dialect.emitters_absorb ? "absorb" : "scatter");
    add("plumb:mirror", on_off(scene.dialect.mirrored_view));
    add("plumb:point", scene.dialect.point_takes_power ? "power" : "radiance");
    add("plumb:envmapFlipped", on_off(scene.dialect.environment_flipped));
    add("plumb:envmapScale", scene.dialect.environment_scale);
    add("plumb:instructionSet", scene.job.scene.options().instruction_set);
    add("plumb:embree", scene.job.scene.embree_version());
    add("plumb:leftOut", std::to_string(left_out.count));
    if (left_out.count > 0) add("plumb:leftOutFirst", left_out_text(left_out.first));
    add("worldToCamera", world_to_camera(*scene.job.camera));
    return header;
}

std::string left_out_text(const LeftOut::Sample& sample)
{
    return fmt::format("sample {} of pixel {},{} ({}: {})", sample.index, sample.pixel.x, sample.pixel.y,
                       verdict_text(sample.verdict), color_text(sample.value));
}

} // namespace plumb
