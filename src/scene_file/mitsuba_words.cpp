// SPDX-License-Identifier: MIT
#include "scene_file/mitsuba_words.h"

#include "scene_file/foreign_names.h"
#include "scene_file/mitsuba06_words.h"
#include "scene_file/mitsuba_values.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::string_view unpolarised =
    "Plumb's light is not polarised; a 'mask' of opacity 0.5 around a black 'diffuse' absorbs as much of it";
constexpr std::string_view as_mesh = "export it as a mesh";
constexpr std::string_view as_envmap = "tools/bake_sky makes an 'envmap' and a 'directional' light of it";
constexpr std::string_view same_light =
    "this is rendered by 'path', which finds the same light up to noise (path_mis in 'renderer types')";

constexpr TagName tags[] = {
    {"scene", "scene"},
    {"integrator", "integrator"},
    {"sensor", "camera"},
    {"film", "film"},
    {"rfilter", "rfilter"},
    {"sampler", "sampler"},
    {"shape", "shape"},
    {"bsdf", "bsdf"},
    {"texture", "texture"},
    {"emitter", "emitter"},
    {"ref", "ref"},
    {"rgb", "color"},
    {"spectrum", "color"},
    {"float", "float"},
    {"integer", "integer"},
    {"boolean", "boolean"},
    {"string", "string"},
    {"point", "point"},
    {"vector", "vector"},
    {"transform", "transform"},
    {"translate", "translate"},
    {"scale", "scale"},
    {"rotate", "rotate"},
    {"lookat", "lookat"},
    {"matrix", "matrix"},
};

constexpr TypeName types[] = {
    {"integrator", "path", "path_mis"},
    {"integrator", "direct", "path_mis"},
    {"integrator", "volpath", "path_mis"}, // in scenes without media the same
    {"integrator", "volpathmis", "path_mis"},
    {"integrator", "ptracer", "path_mis", same_light},
    {"integrator", "bdpt", "path_mis", same_light},
    {"integrator", "photonmapper", "path_mis", same_light},
    {"integrator", "ppm", "path_mis", same_light},
    {"integrator", "sppm", "path_mis", same_light},
    {"integrator", "mlt", "path_mis", same_light},
    {"integrator", "pssmlt", "path_mis", same_light},
    {"integrator", "vcm", "path_mis", same_light},
    {"integrator", "prb", "path_mis", same_light},
    {"integrator", "prb_basic", "path_mis", same_light},
    {"integrator", "prbvolpath", "path_mis", same_light},
    {"integrator", "prb_projective", "path_mis", same_light},
    {"integrator", "direct_projective", "path_mis", same_light},
    {"integrator", "moment", "moment"}, // their child takes their place
    {"integrator", "aov", "aov"},
    {"integrator", "depth", "depth"},

    {"camera", "perspective", "perspective"},
    {"camera", "thinlens", "perspective"},
    {"camera", "orthographic", "orthographic"},
    {"film", "hdrfilm", "hdrfilm"},
    {"rfilter", "box", "box"},
    {"rfilter", "tent", "tent"},
    {"rfilter", "gaussian", "gaussian"},
    {"rfilter", "mitchell", "mitchell"},
    {"rfilter", "catmullrom", "catmullrom"},
    {"rfilter", "lanczos", "lanczos"},
    {"sampler", "independent", "independent"},
    {"sampler", "stratified", "stratified"},
    {"sampler", "multijitter", "stratified"},
    {"sampler", "ldsampler", "sobol"},
    {"sampler", "orthogonal", "sobol"},

    {"shape", "obj", "obj"},
    {"shape", "ply", "ply"},
    {"shape", "serialized", "serialized"},
    {"shape", "sphere", "sphere"},
    {"shape", "rectangle", "rectangle"},
    {"shape", "disk", "disk"},
    {"shape", "cube", "cube"},
    {"shape", "cylinder", "cylinder"},
    {"shape", "shapegroup", "group"},
    {"shape", "instance", "instance"},
    {"shape", "merge", "merge"}, // its shapes take its place

    {"bsdf", "diffuse", "diffuse"},
    {"bsdf", "dielectric", "dielectric"},
    {"bsdf", "thindielectric", "thindielectric"},
    {"bsdf", "roughdielectric", "roughdielectric"},
    {"bsdf", "conductor", "conductor"},
    {"bsdf", "roughconductor", "roughconductor"},
    {"bsdf", "plastic", "plastic"},
    {"bsdf", "roughplastic", "roughplastic"},
    {"bsdf", "principled", "principled"},
    {"bsdf", "principledthin", "principledthin"},
    {"bsdf", "twosided", "twosided"},
    {"bsdf", "mask", "mask"},
    {"bsdf", "null", "null"},
    {"bsdf", "blendbsdf", "blend"},
    {"bsdf", "normalmap", "normalmap"},
    {"bsdf", "bumpmap", "bumpmap"},

    {"texture", "bitmap", "bitmap"},
    {"texture", "checkerboard", "checkerboard"},
    {"texture", "rawconstant", "rawconstant"},
    {"texture", "mesh_attribute", "meshattribute"},

    {"emitter", "area", "area"},
    {"emitter", "point", "point"},
    {"emitter", "spot", "spot"},
    {"emitter", "projector", "projector"},
    {"emitter", "directional", "directional"},
    {"emitter", "constant", "environment"},
    {"emitter", "envmap", "environment"},
};

constexpr ParamName params[] = {
    {"integrator", "moment", "*", ""},
    {"integrator", "aov", "*", ""},
    {"integrator", "direct", "hide_emitters", "hideEmitters"},
    {"integrator", "", "max_depth", "maxDepth", depth_minus_one},
    {"integrator", "", "rr_depth", "rrDepth"},
    {"integrator", "", "hide_emitters", "hideEmitters"},

    {"camera", "perspective", "to_world", "toWorld", without_scale},
    {"camera", "thinlens", "to_world", "toWorld", without_scale},
    {"camera", "orthographic", "to_world", "toWorld"},
    {"camera", "", "near_clip", "nearClip"},
    {"camera", "", "far_clip", "farClip"},
    {"camera", "perspective", "fov", "fov"},
    {"camera", "perspective", "fov_axis", "fovAxis"},
    {"camera", "perspective", "focal_length", "focalLengthMm", millimetres},
    {"camera", "perspective", "principal_point_offset_x", "principalPointOffsetX"},
    {"camera", "perspective", "principal_point_offset_y", "principalPointOffsetY"},
    {"camera", "thinlens", "fov", "fov"},
    {"camera", "thinlens", "fov_axis", "fovAxis"},
    {"camera", "thinlens", "focal_length", "focalLengthMm", millimetres},
    {"camera", "thinlens", "aperture_radius", "lensRadius"},
    {"camera", "thinlens", "focus_distance", "focalDistance"},

    {"film", "", "pixel_format", "", only_rgb},
    {"film", "", "width", "width"},
    {"film", "", "height", "height"},
    {"film", "", "crop_offset_x", "cropOffsetX"},
    {"film", "", "crop_offset_y", "cropOffsetY"},
    {"film", "", "crop_width", "cropWidth"},
    {"film", "", "crop_height", "cropHeight"},
    {"film", "", "sample_border", "sampleBorder"},
    {"rfilter", "gaussian", "stddev", "stddev"},
    {"rfilter", "tent", "radius", "radius"},
    {"rfilter", "box", "radius", "radius"},
    {"rfilter", "lanczos", "lobes", "lobes"},
    {"sampler", "", "sample_count", "sampleCount"},

    {"shape", "", "to_world", "toWorld"},
    {"shape", "obj", "filename", "filename"},
    {"shape", "obj", "face_normals", "faceNormals", only_if_true},
    {"shape", "obj", "flip_tex_coords", "flipV"},
    {"shape", "obj", "flip_normals", "flipNormals"},
    {"shape", "ply", "filename", "filename"},
    {"shape", "ply", "face_normals", "faceNormals", only_if_true},
    {"shape", "ply", "flip_tex_coords", "flipV"},
    {"shape", "ply", "flip_normals", "flipNormals"},
    {"shape", "serialized", "filename", "filename"},
    {"shape", "serialized", "shape_index", "shapeIndex"},
    {"shape", "serialized", "face_normals", "faceNormals", only_if_true},
    {"shape", "serialized", "flip_tex_coords", "flipV"},
    {"shape", "serialized", "flip_normals", "flipNormals"},
    {"shape", "sphere", "center", "center"},
    {"shape", "sphere", "radius", "radius"},
    {"shape", "sphere", "flip_normals", "flipNormals"},
    {"shape", "rectangle", "flip_normals", "flipNormals"},
    {"shape", "disk", "flip_normals", "flipNormals"},
    {"shape", "cube", "flip_normals", "flipNormals"},
    {"shape", "cylinder", "p0", "p0"},
    {"shape", "cylinder", "p1", "p1"},
    {"shape", "cylinder", "radius", "radius"},
    {"shape", "cylinder", "flip_normals", "flipNormals"},

    {"bsdf", "diffuse", "reflectance", "albedo", color_of_reflectance},
    {"bsdf", "", "int_ior", "intIOR", index_by_name},
    {"bsdf", "", "ext_ior", "extIOR", index_by_name},
    {"bsdf", "", "specular_reflectance", "specularReflectance", color_of_reflectance},
    {"bsdf", "", "specular_transmittance", "specularTransmittance", color_of_reflectance},
    {"bsdf", "", "diffuse_reflectance", "diffuseReflectance", color_of_reflectance},
    {"bsdf", "", "nonlinear", "nonlinear"},
    {"bsdf", "conductor", "material", "material"},
    {"bsdf", "conductor", "eta", "eta", color_of_index},
    {"bsdf", "conductor", "k", "k", color_of_index},
    {"bsdf", "roughconductor", "material", "material"},
    {"bsdf", "roughconductor", "eta", "eta", color_of_index},
    {"bsdf", "roughconductor", "k", "k", color_of_index},
    {"bsdf", "", "distribution", "distribution"},
    {"bsdf", "", "alpha", "alpha", to_number},
    {"bsdf", "", "alpha_u", "alphaU", to_number},
    {"bsdf", "", "alpha_v", "alphaV", to_number},
    {"bsdf", "", "base_color", "baseColor", color_of_reflectance},
    {"bsdf", "", "roughness", "roughness", to_number},
    {"bsdf", "", "anisotropic", "anisotropic", to_number},
    {"bsdf", "", "metallic", "metallic", to_number},
    {"bsdf", "", "spec_trans", "specTrans", to_number},
    {"bsdf", "", "eta", "eta", to_number},
    {"bsdf", "", "specular", "specular", to_number},
    {"bsdf", "", "spec_tint", "specTint", to_number},
    {"bsdf", "", "sheen", "sheen", to_number},
    {"bsdf", "", "sheen_tint", "sheenTint", to_number},
    {"bsdf", "", "flatness", "flatness", to_number},
    {"bsdf", "", "clearcoat", "clearcoat", to_number},
    {"bsdf", "", "clearcoat_gloss", "clearcoatGloss", to_number},
    {"bsdf", "", "diff_trans", "diffTrans", to_number},
    {"bsdf", "mask", "opacity", "opacity", to_number},
    {"bsdf", "blendbsdf", "weight", "weight", to_number},
    {"bsdf", "normalmap", "normalmap", "normal"},
    {"bsdf", "", "use_shadowing_function", "useShadowing"},
    {"bsdf", "", "flip_invalid_normals", "flipInvalidNormals"},
    {"bsdf", "bumpmap", "scale", "scale"},
    {"bsdf", "bumpmap", "*", ""}, // the texture has any name

    {"texture", "bitmap", "filename", "filename"},
    {"texture", "bitmap", "raw", "raw"},
    {"texture", "bitmap", "filter_type", "filter"},
    {"texture", "bitmap", "wrap_mode", "wrap"},
    {"texture", "", "to_uv", "toUv"},
    {"texture", "checkerboard", "color0", "color0", color_of_index},
    {"texture", "checkerboard", "color1", "color1", color_of_index},
    {"texture", "rawconstant", "value", "value"},
    {"texture", "mesh_attribute", "name", "attribute"},

    {"emitter", "area", "radiance", "radiance", color_of_emission},
    {"emitter", "point", "intensity", "radiance", color_of_emission},
    {"emitter", "point", "position", "position"},
    {"emitter", "point", "to_world", "position", position_of},
    {"emitter", "directional", "irradiance", "radiance", color_of_emission},
    {"emitter", "directional", "direction", "direction"},
    {"emitter", "directional", "to_world", "direction", direction_of},
    {"emitter", "spot", "to_world", "toWorld"},
    {"emitter", "spot", "intensity", "intensity", color_of_emission},
    {"emitter", "spot", "cutoff_angle", "cutoffAngle"},
    {"emitter", "spot", "beam_width", "beamWidth"},
    {"emitter", "spot", "texture", "texture"},
    {"emitter", "projector", "to_world", "toWorld"},
    {"emitter", "projector", "irradiance", "irradiance", color_of_emission},
    {"emitter", "projector", "scale", "scale"},
    {"emitter", "projector", "fov", "fov"},
    {"emitter", "projector", "fov_axis", "fovAxis"},
    {"emitter", "projector", "focal_length", "focalLengthMm", millimetres},
    {"emitter", "constant", "radiance", "radiance", color_of_emission},
    {"emitter", "envmap", "filename", "filename"},
    {"emitter", "envmap", "scale", "scale"},
    {"emitter", "envmap", "to_world", "toWorld"},
};

constexpr Preset presets[] = {
    {"integrator", "direct", "integer", "maxDepth", "1"},
    {"integrator", "direct_projective", "integer", "maxDepth", "1"},
    {"integrator", "prb", "integer", "maxDepth", "5"},
    {"integrator", "prb_basic", "integer", "maxDepth", "5"},
    {"integrator", "prbvolpath", "integer", "maxDepth", "5"},
    {"integrator", "prb_projective", "integer", "maxDepth", "5"},
    {"integrator", "depth", "boolean", "inverse", "false"},
    {"integrator", "", "boolean", "countPasses", "true"},
    {"integrator", "", "integer", "rrDepth", "5"},
    {"camera", "perspective", "float", "nearClip", "0.01"},
    {"camera", "perspective", "float", "farClip", "10000"},
    {"camera", "perspective", "float", "focalLengthMm", "50", "fov"},
    {"camera", "thinlens", "float", "nearClip", "0.01"},
    {"camera", "thinlens", "float", "farClip", "10000"},
    {"camera", "thinlens", "float", "focalLengthMm", "50", "fov"},
    {"camera", "orthographic", "float", "nearClip", "0.01"},
    {"camera", "orthographic", "float", "farClip", "10000"},
    {"film", "", "integer", "width", "768"},
    {"film", "", "integer", "height", "576"},
    {"film", "", "boolean", "sampleBorder", "false"},
    {"sampler", "", "integer", "sampleCount", "4"},

    {"shape", "rectangle", "float", "width", "2"},
    {"shape", "rectangle", "float", "height", "2"},
    {"shape", "cube", "float", "width", "2"},
    {"shape", "sphere", "boolean", "flipU", "true"},
    {"shape", "obj", "boolean", "smooth", "true", "faceNormals"},
    {"shape", "obj", "boolean", "flipV", "true"},
    {"shape", "obj", "boolean", "materials", "false"},
    {"shape", "ply", "boolean", "smooth", "true", "faceNormals"},
    {"shape", "serialized", "boolean", "smooth", "true", "faceNormals"},

    {"bsdf", "dielectric", "float", "intIOR", "1.5046"},
    {"bsdf", "dielectric", "float", "extIOR", "1.000277"},
    {"bsdf", "thindielectric", "float", "intIOR", "1.5046"},
    {"bsdf", "thindielectric", "float", "extIOR", "1.000277"},
    {"bsdf", "roughdielectric", "float", "intIOR", "1.5046"},
    {"bsdf", "roughdielectric", "float", "extIOR", "1.000277"},
    {"bsdf", "roughdielectric", "float", "alpha", "0.1", "alphaU"},
    {"bsdf", "roughconductor", "string", "material", "none", "eta"},
    {"bsdf", "roughconductor", "float", "alpha", "0.1", "alphaU"},
    {"bsdf", "plastic", "float", "intIOR", "1.49"},
    {"bsdf", "plastic", "float", "extIOR", "1.000277"},
    {"bsdf", "roughplastic", "float", "intIOR", "1.49"},
    {"bsdf", "roughplastic", "float", "extIOR", "1.000277"},
    {"bsdf", "roughplastic", "float", "alpha", "0.1"},
    {"bsdf", "normalmap", "boolean", "useShadowing", "true"},
    {"bsdf", "bumpmap", "boolean", "useShadowing", "true"},

    {"texture", "bitmap", "string", "vOrigin", "top"},
    {"texture", "checkerboard", "boolean", "swapNumbers", "true"},

    {"emitter", "projector", "boolean", "flipV", "true"},
    {"emitter", "envmap", "float", "columnOffset", "0.25"},
    {"emitter", "envmap", "boolean", "rowsAtPoles", "true"},
};

constexpr Refusal refusals[] = {
    {"medium", "", vacuum_only, true},
    {"volume", "", vacuum_only, true},
    {"phase", "", vacuum_only, true},
    {"animation", "", "Plumb renders one moment: use one <transform>", false, "transform"},
    {"blackbody", "", "write <spectrum type=\"blackbody\" name=\"...\">"},
    {"srgb", "", "write it as a linear <rgb>"},
    {"shape", "sdfgrid", as_mesh},
    {"shape", "bsplinecurve", as_mesh},
    {"shape", "linearcurve", as_mesh},
    {"shape", "ellipsoids", as_mesh},
    {"shape", "ellipsoidsmesh", as_mesh},
    {"bsdf", "hair", "use 'principled' on a mesh of the hair"},
    {"bsdf", "measured", "use 'principled', or 'roughconductor' with a material"},
    {"bsdf", "measured_polarized", "use 'principled', or 'roughconductor' with a material"},
    {"bsdf", "polarizer", unpolarised},
    {"bsdf", "retarder",
     "Plumb's light is not polarised, and passes a 'null' surface as it would pass this one"},
    {"bsdf", "circular", unpolarised},
    {"bsdf", "pplastic", "use 'roughplastic'"},
    {"emitter", "sunsky", as_envmap},
    {"emitter", "timed_sunsky", as_envmap},
    {"emitter", "sky", as_envmap},
    {"emitter", "directionalarea", "use 'projector' or 'spot' with a small angle, or 'directional'"},
    {"texture", "volume", "use 'bitmap', or 'mesh_attribute' for values at vertices"},
    {"camera", "irradiancemeter",
     "use 'perspective', and look at a white 'diffuse' surface: it shows irradiance / pi"},
    {"camera", "radiancemeter", "use 'perspective' with a small fov"},
    {"camera", "distant", "use 'orthographic'"},
    {"camera", "batch", "write one file for each sensor"},
    {"film", "specfilm", "use 'hdrfilm'"},
    {"film", "ldrfilm", "use 'hdrfilm'; 'renderer' also writes .png"},
    {"integrator", "stokes", "Plumb's light is not polarised; write the integrator that is inside it alone"},
};

constexpr Ignored ignored[] = {
    {"integrator", "direct", "emitter_samples"},
    {"integrator", "direct", "bsdf_samples"},
    {"integrator", "direct", "shading_samples"},
    {"integrator", "direct_projective", "sppc"},
    {"integrator", "direct_projective", "sppp"},
    {"integrator", "direct_projective", "sppi"},
    {"integrator", "prb_projective", "sppc"},
    {"integrator", "prb_projective", "sppp"},
    {"integrator", "prb_projective", "sppi"},
    {"integrator", "", "samples_per_pass"},
    {"integrator", "", "timeout"},
    {"integrator", "", "block_size"},
    {"camera", "perspective", "focus_distance"},
    {"camera", "", "shutter_open"},
    {"camera", "", "shutter_close"},
    {"film", "", "component_format"},
    {"film", "", "file_format"},
    {"film", "", "banner"},
    {"film", "", "compensate"},
    {"sampler", "", "seed"},
    {"sampler", "", "jitter"},
    {"bsdf", "", "sample_visible"},
    {"bsdf", "", "main_specular_sampling_rate"},
    {"bsdf", "", "clearcoat_sampling_rate"},
    {"bsdf", "", "diffuse_reflectance_sampling_rate"},
    {"bsdf", "", "specular_reflectance_sampling_rate"},
    {"bsdf", "", "diffuse_transmittance_sampling_rate"},
    {"bsdf", "", "specular_transmittance_sampling_rate"},
    {"texture", "bitmap", "format"},
    {"texture", "bitmap", "accel"},
    {"emitter", "", "sampling_weight"},
    {"emitter", "envmap", "mis_compensation"},
};

constexpr Vocabulary mitsuba3 = {.name = "mitsuba3",
                                 .tags = tags,
                                 .types = types,
                                 .params = params,
                                 .presets = presets,
                                 .refusals = refusals,
                                 .ignored = ignored,
                                 .complete = true,
                                 .syntax = mitsuba_syntax,
                                 .order = order_mitsuba};

} // namespace

bool is_mitsuba_scene(const Element& root)
{
    if (root.tag != "scene" || !root.attribute("version") || root.attribute("dialect")) return false;
    // Forks of Nori write a version, too; but Mitsuba has no <camera> and no <mesh>.
    const auto has = [&](std::string_view tag) {
        return std::any_of(root.children.begin(), root.children.end(),
                           [&](const Element& child) { return child.tag == tag; });
    };
    return has("sensor") || !(has("camera") || has("mesh"));
}

const Vocabulary* mitsuba_vocabulary_named(std::string_view name)
{
    static const Vocabulary mitsuba06 = mitsuba06_vocabulary(mitsuba3);
    return name == mitsuba3.name ? &mitsuba3 : name == mitsuba06.name ? &mitsuba06 : nullptr;
}

DialectChoice mitsuba_choice(const Element& root, const DialectWishes& wishes, Diagnostics& diagnostics)
{
    const Attribute& version = *root.attribute("version");
    DialectChoice choice;
    choice.dialect = Dialect::standard(DialectName::mitsuba3);
    choice.dialect.reason = fmt::format("the file has version {}", version.value);
    choice.dialect.emitters_absorb = wishes.emitters_absorb.value_or(false);
    choice.dialect.mirrored_view = wishes.mirrored_view.value_or(false);
    choice.dialect.environment_scale = wishes.environment_scale.value_or(1.f);
    if (wishes.name)
        diagnostics.error(
            root.name_place(version),
            fmt::format("--dialect {}: the attribute 'version' says that this is a scene of Mitsuba",
                        to_string(*wishes.name)));
    return choice;
}

const Vocabulary* mitsuba_vocabulary(const Element& root, Diagnostics& diagnostics)
{
    const Attribute& version = *root.attribute("version");
    int major = 0;
    const char* const end = version.value.data() + version.value.size();
    const auto [rest, error] = std::from_chars(version.value.data(), end, major);
    if (error != std::errc() || (rest != end && *rest != '.')) {
        diagnostics.error(root.value_place(version),
                          fmt::format("'{}' is not a version of Mitsuba, as '3.0.0' is", version.value));
        return nullptr;
    }
    if (major >= 2 && major <= 3) return &mitsuba3;
    if (major < 2 && major >= 0) return mitsuba_vocabulary_named("mitsuba06");
    diagnostics.error(
        root.value_place(version),
        fmt::format("scenes of Mitsuba {} are not supported; those of 0.4 to 3.x are", version.value));
    return nullptr;
}

} // namespace plumb
