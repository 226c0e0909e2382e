// SPDX-License-Identifier: MIT
#include "scene_file/nori_words.h"

#include "scene_file/fork_words.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// Other names of our types, in all dialects.
constexpr TypeName types[] = {
    {"emitter", "pointlight", "point"},           {"camera", "thinlens", "perspective"},
    {"camera", "perspective_dof", "perspective"}, {"camera", "perspective_depth", "perspective"},
    {"integrator", "path_ems", "path_nee"},
};

constexpr ParamName params[] = {
    {"camera", "thinlens", "focalLength", "focalDistance"},
    {"camera", "perspective_depth", "apertureradius", "lensRadius"},
    {"camera", "perspective_depth", "focaldistance", "focalDistance"},
};

constexpr Preset presets[] = {
    {"emitter", "pointlight", "point", "position", "0 100 0"},
    // A thin lens without a focal length is a pinhole.
    {"camera", "thinlens", "float", "lensRadius", "0", "focalDistance", true},
    {"camera", "perspective_depth", "float", "lensRadius", "0.2"},
    // It must be given.
    {"camera", "perspective_depth", "float", "focalDistance", "0"},
};

constexpr Ignored ignored[] = {
    {"camera", "perspective_depth", "focallength"},
};

constexpr Vocabulary nori = {.name = "nori",
                             .types = types,
                             .params = params,
                             .presets = presets,
                             .ignored = ignored,
                             .base = &fork_words};

// No course's renderer reads MTL files.
constexpr Preset course_presets[] = {
    {"shape", "obj", "boolean", "materials", "false"},
};
constexpr Preset mcgill_presets[] = {
    {"shape", "obj", "boolean", "materials", "false"},
    {"emitter", "area", "color", "radiance", "0 0 0"},
    {"emitter", "point", "color", "radiance", "0 0 0", "power"},
};

constexpr Vocabulary plumb_words = {.name = "plumb", .base = &nori};
constexpr Vocabulary epfl = {.name = "epfl", .presets = course_presets, .base = &nori};
constexpr Vocabulary eth = {.name = "eth", .presets = course_presets, .base = &nori};
constexpr Vocabulary zaragoza = {.name = "zaragoza", .presets = course_presets, .base = &nori};
constexpr Vocabulary mcgill = {.name = "mcgill", .presets = mcgill_presets, .base = &nori};

constexpr std::string_view mirrored_cameras[] = {
    "perspective",  "thinlens",  "perspective_dof", "perspective_depth",
    "orthographic", "spherical", "fisheye"};

} // namespace

const Vocabulary& nori_vocabulary(DialectName name)
{
    switch (name) {
    case DialectName::plumb:
    case DialectName::mitsuba3: break;
    case DialectName::epfl: return epfl;
    case DialectName::eth: return eth;
    case DialectName::zaragoza: return zaragoza;
    case DialectName::mcgill: return mcgill;
    }
    return plumb_words;
}

std::span<const TypeName> other_type_names()
{
    return types;
}

std::string manual_of_other_name(const TypeName& type, std::string_view manual)
{
    std::string text = fmt::format("Another name of '{}'.", type.ours);
    for (const ParamName& param : params)
        if (param.kind == type.kind && param.type == type.theirs)
            text += fmt::format(" `{}` is {}.", param.theirs, param.ours);
    for (const Preset& preset : presets)
        if (preset.kind == type.kind && preset.type == type.theirs)
            text += preset.unless.empty()
                        ? fmt::format(" Unless given, {} is {}.", preset.name, preset.value)
                        : fmt::format(" Without {}, {} is {}.", preset.unless, preset.name, preset.value);
    return text.append("\n\n").append(manual);
}

Readings::Readings(const Dialect& dialect, const DialectWishes& wishes)
{
    // What the command line says also replaces what the file says.
    const auto add = [&](std::string_view kind, std::string_view type, std::string_view tag,
                         std::string_view name, std::string value, bool replaces) {
        texts_.push_back(std::move(value));
        presets_.push_back({kind, type, tag, name, texts_.back(), {}, replaces});
    };
    if (dialect.mirrored_view || wishes.mirrored_view)
        for (const std::string_view type : mirrored_cameras)
            add("camera", type, "boolean", "mirrored", dialect.mirrored_view ? "true" : "false",
                wishes.mirrored_view.has_value());
    if (dialect.environment_flipped) add("emitter", "environment", "boolean", "flipped", "true", false);
    if (dialect.environment_scale != 1.f || wishes.environment_scale)
        add("emitter", "environment", "float", "imageScale", fmt::format("{}", dialect.environment_scale),
            wishes.environment_scale.has_value());
    if (dialect.point_takes_power)
        presets_.push_back({"emitter", "point", "color", "power", "1 1 1", "radiance"});
    if (dialect.sun_points_to_light) add("emitter", "directional", "boolean", "pointsToLight", "true", false);
}

Element arrange(Element root, const Dialect& dialect, const DialectWishes& wishes, Diagnostics& diagnostics)
{
    const Readings readings(dialect, wishes);
    return arrange(std::move(root), nori_vocabulary(dialect.name), {.overrides = readings.presets()},
                   diagnostics);
}

} // namespace plumb
