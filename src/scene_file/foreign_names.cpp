// SPDX-License-Identifier: MIT
#include "scene_file/foreign_names.h"

#include "scene_file/folded_name.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view use_image_texture = "use 'bitmap' with <string name=\"filename\">";
constexpr std::string_view use_tube =
    "use an 'area' emitter on a small shape inside a black tube, or 'point'";
constexpr std::string_view use_cloth = "use 'principled', whose sheen is like cloth";

constexpr ForeignName foreign_entries[] = {
    {"tag", "medium", "", vacuum_only},
    {"tag", "phase", "", vacuum_only},
    {"tag", "volume", "", vacuum_only},
    {"tag", "denoiser", "",
     "Plumb's images are unbiased estimates; denoise the written .exr with another program"},
    {"tag", "sensor", "camera", ""},
    {"tag", "rgb", "color", ""},
    {"tag", "srgb", "", "write it as a linear <color>"},
    {"tag", "spectrum", "color", ""},
    {"tag", "blackbody", "", "write it as a <color>"},
    {"tag", "film", "", "width and height are parameters of <camera>"},
    {"tag", "light", "emitter", ""},
    {"tag", "material", "bsdf", ""},
    {"tag", "brdf", "bsdf", ""},
    {"tag", "filter", "rfilter", ""},
    {"tag", "int", "integer", ""},
    {"tag", "bool", "boolean", ""},
    {"tag", "double", "float", ""},

    {"integrator", "material", "", "use 'normals', or 'direct' with a 'point' light"},
    {"integrator", "aov", "", "use 'normals' or 'depth'"},

    {"bsdf", "metal", "roughconductor", ""},
    {"bsdf", "roughmetal", "roughconductor", ""},
    {"bsdf", "substrate", "roughsubstrate", ""},
    {"bsdf", "blinn", "", "use 'phong'"},
    {"bsdf", "blinn_phong", "", "use 'phong'"},
    {"bsdf", "irawan", "", use_cloth},
    {"bsdf", "oren_nayar", "", "use 'diffuse'"},

    {"shape", "plane", "", "use 'rectangle', or an 'obj' mesh"},
    {"shape", "quad", "rectangle", ""},
    {"shape", "square", "rectangle", ""},
    {"shape", "box", "", "use an 'obj' mesh"},
    {"shape", "shapegroup", "group", ""},

    {"emitter", "sky", "environment", ""},
    {"emitter", "distantdisk", "", "use 'environment', or 'directional' for a small disk"},
    {"emitter", "texturearea", "", "use 'area' with <texture name=\"radiance\">"},
    {"emitter", "rectEmitter", "", "use 'area' on a 'rectangle'"},
    {"emitter", "diskEmitter", "", "use 'area' on a 'disk'"},
    {"emitter", "sphereEmitter", "", "use 'area' on a 'sphere'"},

    {"texture", "wood", "", use_image_texture},

    {"sampler", "random", "independent", ""},
    {"sampler", "halton", "", "use 'sobol'"},
    {"sampler", "hammersley", "", "use 'sobol'"},
    {"sampler", "ldsampler", "", "use 'sobol'"},
    {"sampler", "multijitter", "", "use 'stratified'"},
    {"sampler", "orthogonal", "", "use 'sobol'"},

    {"rfilter", "triangle", "tent", ""},
};

const ForeignName* find(std::string_view kind, std::string_view name)
{
    const std::string wanted = folded(name);
    for (const ForeignName& entry : foreign_entries)
        if (entry.kind == kind && folded(entry.name) == wanted) return &entry;
    return nullptr;
}

} // namespace

std::span<const ForeignName> foreign_names()
{
    return foreign_entries;
}

std::optional<std::string> foreign_type(std::string_view kind, std::string_view name)
{
    const ForeignName* entry = find(kind, name);
    if (!entry) return {};
    return entry->ours.empty() ? fmt::format("{} '{}' is not supported; {}", kind, name, entry->advice)
                               : fmt::format("{} '{}' is '{}' here", kind, name, entry->ours);
}

std::optional<std::string> foreign_tag(std::string_view tag)
{
    const ForeignName* entry = find("tag", tag);
    if (!entry) return {};
    return entry->ours.empty() ? fmt::format("<{}> is not supported; {}", tag, entry->advice)
                               : fmt::format("<{}> is <{}> here", tag, entry->ours);
}

} // namespace plumb
