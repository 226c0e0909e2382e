// SPDX-License-Identifier: MIT
#include "scene_file/foreign_names.h"

#include "base/lower_case.h"

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view vacuum = "Plumb renders surfaces in a vacuum only";
constexpr std::string_view vacuum_path = "Plumb renders surfaces in a vacuum only; use 'path_mis'";
constexpr std::string_view use_path_mis = "use 'path_mis'";
constexpr std::string_view use_image_texture = "use 'bitmap' with <string name=\"filename\">";
constexpr std::string_view use_tube =
    "use an 'area' emitter on a small shape inside a black tube, or 'point'";
constexpr std::string_view use_coat = "use 'principled' or 'roughplastic'";

constexpr ForeignName names[] = {
    {"tag", "medium", "", vacuum},
    {"tag", "phase", "", vacuum},
    {"tag", "volume", "", vacuum},
    {"tag", "denoiser", "",
     "Plumb's images are unbiased estimates; denoise the written .exr with another program"},
    {"tag", "sensor", "camera", ""},
    {"tag", "rgb", "color", ""},
    {"tag", "srgb", "", "write it as a linear <color>"},
    {"tag", "spectrum", "color", ""},
    {"tag", "blackbody", "", "write it as a <color>"},
    {"tag", "film", "", "width and height are parameters of <camera>"},
    {"tag", "light", "emitter", ""},
    {"tag", "luminaire", "emitter", ""},
    {"tag", "material", "bsdf", ""},
    {"tag", "brdf", "bsdf", ""},
    {"tag", "filter", "rfilter", ""},
    {"tag", "int", "integer", ""},
    {"tag", "bool", "boolean", ""},
    {"tag", "double", "float", ""},

    {"integrator", "mipath", "path_mis", ""},
    {"integrator", "mispath", "path_mis", ""},
    {"integrator", "path_tracer", "path_mis", ""},
    {"integrator", "path_tracing", "path_mis", ""},
    {"integrator", "pathtrace", "path_mis", ""},
    {"integrator", "path_tracer_mis", "path_mis", ""},
    {"integrator", "path_tracer_recursive", "path_mis", ""},
    {"integrator", "path_simple", "path_mats", ""},
    {"integrator", "bsdfpath", "path_mats", ""},
    {"integrator", "brdfpath", "path_mats", ""},
    {"integrator", "path_bsdf", "path_mats", ""},
    {"integrator", "path_brdf", "path_mats", ""},
    {"integrator", "path_tracer_mats", "path_mats", ""},
    {"integrator", "path_direct", "path_nee", ""},
    {"integrator", "path_emitter", "path_nee", ""},
    {"integrator", "path_light", "path_nee", ""},
    {"integrator", "path_tracer_ems", "path_nee", ""},
    {"integrator", "path_tracer_nee", "path_nee", ""},
    {"integrator", "midirect", "direct_mis", ""},
    {"integrator", "misdirect", "direct_mis", ""},
    {"integrator", "direct_lighting", "direct_mis", ""},
    {"integrator", "direct_illumination", "direct_mis", ""},
    {"integrator", "bsdfdirect", "direct_mats", ""},
    {"integrator", "direct_bsdf", "direct_mats", ""},
    {"integrator", "direct_brdf", "direct_mats", ""},
    {"integrator", "direct_material", "direct_mats", ""},
    {"integrator", "direct_light", "direct_ems", ""},
    {"integrator", "direct_emitter", "direct_ems", ""},
    {"integrator", "direct_nee", "direct_ems", ""},
    {"integrator", "material", "", "use 'normals', or 'direct' with a 'point' light"},
    {"integrator", "ambient_occlusion", "ao", ""},
    {"integrator", "average_visibility", "av", ""},
    {"integrator", "normal", "normals", ""},
    {"integrator", "volume", "", vacuum_path},
    {"integrator", "volpath", "", vacuum_path},
    {"integrator", "volpath_simple", "", vacuum_path},
    {"integrator", "volpath_mis", "", vacuum_path},
    {"integrator", "volpath_mats", "", vacuum_path},
    {"integrator", "volpath_mis_simple", "", vacuum_path},
    {"integrator", "volpath_tracer", "", vacuum_path},
    {"integrator", "volumetric_path", "", vacuum_path},
    {"integrator", "volumetric_path_tracer", "", vacuum_path},
    {"integrator", "volume_path", "", vacuum_path},
    {"integrator", "photonmapper", "", use_path_mis},
    {"integrator", "photonmapping", "", use_path_mis},
    {"integrator", "photonmap", "", use_path_mis},
    {"integrator", "progressive_photonmapper", "", use_path_mis},
    {"integrator", "ppm", "", use_path_mis},
    {"integrator", "sppm", "", use_path_mis},
    {"integrator", "bdpt", "", use_path_mis},
    {"integrator", "vcm", "", use_path_mis},
    {"integrator", "mlt", "", use_path_mis},
    {"integrator", "pssmlt", "", use_path_mis},
    {"integrator", "ptracer", "", use_path_mis},
    {"integrator", "light_tracer", "", use_path_mis},
    {"integrator", "irrcache", "", use_path_mis},
    {"integrator", "aov", "", "use 'normals' or 'depth'"},

    {"bsdf", "lambertian", "diffuse", ""},
    {"bsdf", "lambert", "diffuse", ""},
    {"bsdf", "matte", "diffuse", ""},
    {"bsdf", "glass", "dielectric", ""},
    {"bsdf", "smooth_conductor", "conductor", ""},
    {"bsdf", "metal", "roughconductor", ""},
    {"bsdf", "roughmetal", "roughconductor", ""},
    {"bsdf", "roughglass", "roughdielectric", ""},
    {"bsdf", "frosted_glass", "roughdielectric", ""},
    {"bsdf", "substrate", "roughsubstrate", ""},
    {"bsdf", "disney", "", use_coat},
    {"bsdf", "disney_brdf", "", use_coat},
    {"bsdf", "disney_bsdf", "", use_coat},
    {"bsdf", "blinn", "", "use 'phong'"},
    {"bsdf", "blinn_phong", "", "use 'phong'"},
    {"bsdf", "oren_nayar", "", "use 'diffuse'"},
    {"bsdf", "blendbsdf", "blend", ""},
    {"bsdf", "mix", "blend", ""},

    {"shape", "plane", "", "use 'rectangle', or an 'obj' mesh"},
    {"shape", "quad", "rectangle", ""},
    {"shape", "square", "rectangle", ""},
    {"shape", "box", "", "use an 'obj' mesh"},
    {"shape", "disc", "disk", ""},
    {"shape", "circle", "disk", ""},
    {"shape", "shapegroup", "group", ""},
    {"shape", "mesh", "obj", ""},
    {"shape", "trianglemesh", "obj", ""},

    {"emitter", "arealight", "area", ""},
    {"emitter", "area_emitter", "area", ""},
    {"emitter", "point_emitter", "point", ""},
    {"emitter", "envmap", "environment", ""},
    {"emitter", "env_map_light", "environment", ""},
    {"emitter", "environmentmap", "environment", ""},
    {"emitter", "environment_light", "environment", ""},
    {"emitter", "infinite", "environment", ""},
    {"emitter", "ibl", "environment", ""},
    {"emitter", "constant", "environment", ""},
    {"emitter", "sky", "environment", ""},
    {"emitter", "distant", "directional", ""},
    {"emitter", "distant_light", "directional", ""},
    {"emitter", "directional_light", "directional", ""},
    {"emitter", "sun", "directional", ""},
    {"emitter", "spotlight", "", use_tube},
    {"emitter", "spot_emitter", "", use_tube},
    {"emitter", "distantdisk", "", "use 'environment', or 'directional' for a small disk"},
    {"emitter", "texturearea", "", "use 'area' with <texture name=\"radiance\">"},
    {"emitter", "rectEmitter", "", "use 'area' on a 'rectangle'"},
    {"emitter", "diskEmitter", "", "use 'area' on a 'disk'"},
    {"emitter", "sphereEmitter", "", "use 'area' on a 'sphere'"},

    {"texture", "wood", "", use_image_texture},
    {"texture", "uvtexture", "", use_image_texture},
    {"texture", "imagetexture", "", use_image_texture},
    {"texture", "image", "", use_image_texture},
    {"texture", "imagemap", "", use_image_texture},
    {"texture", "png_texture", "", use_image_texture},
    {"texture", "constanttexture", "", "use 'constant_color'"},
    {"texture", "constant", "", "use 'constant_color'"},
    {"texture", "checkers", "checker", ""},

    {"camera", "pinhole", "perspective", ""},
    {"camera", "projective", "perspective", ""},
    {"camera", "dof", "thinlens", ""},

    {"sampler", "random", "independent", ""},
    {"sampler", "halton", "", "use 'sobol'"},
    {"sampler", "hammersley", "", "use 'sobol'"},
    {"sampler", "ldsampler", "", "use 'sobol'"},
    {"sampler", "multijitter", "", "use 'stratified'"},
    {"sampler", "orthogonal", "", "use 'sobol'"},

    {"rfilter", "triangle", "tent", ""},
};

// Without what people write in different ways.
std::string folded(std::string_view name)
{
    std::string text;
    for (const char c : name)
        if (c != '_' && c != '-' && c != ' ') text += lower_case(c);
    return text;
}

const ForeignName* find(std::string_view kind, std::string_view name)
{
    const std::string wanted = folded(name);
    for (const ForeignName& entry : names)
        if (entry.kind == kind && folded(entry.name) == wanted) return &entry;
    return nullptr;
}

} // namespace

std::span<const ForeignName> foreign_names()
{
    return names;
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
