// SPDX-License-Identifier: MIT
#include "scene_file/mitsuba06_words.h"

#include "base/lower_case.h"
#include "scene_file/mitsuba_values.h"
#include "scene_file/mitsuba_words.h"
#include "scene_file/property_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

namespace plumb {

namespace {

bool is_upper(char c)
{
    return c >= 'A' && c <= 'Z';
}

bool is_lower(char c)
{
    return c >= 'a' && c <= 'z';
}

// --- Values ---------------------------------------------------------------------------------------------------

double linear_of_srgb(double x)
{
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

// "#ff8000" as three numbers in [0, 1].
std::optional<Vec3d> read_hex(std::string_view text)
{
    if (text.size() != 7 || text[0] != '#') return {};
    Vec3d color;
    for (int i = 0; i < 3; ++i) {
        unsigned byte = 0;
        const char* const begin = text.data() + 1 + 2 * i;
        const auto [end, error] = std::from_chars(begin, begin + 2, byte, 16);
        if (error != std::errc() || end != begin + 2) return {};
        color[i] = byte / 255.0;
    }
    return color;
}

// Colours are linear <rgb>, whatever they are written as; spectra of one or three numbers are such colours here.
bool color_syntax(Element& element, Diagnostics& diagnostics)
{
    const Attribute* value = element.attribute("value");
    if (!value || value->broken || element.attribute("type")) return true;
    const bool is_srgb = element.tag == "srgb";
    std::optional<Vec3d> color = read_hex(value->value);
    if (!color) {
        if (element.tag == "spectrum" && value->value.find(':') != std::string::npos) return true;
        const auto numbers = read_numbers(element, *value, {3, 1}, diagnostics);
        if (!numbers) return false;
        color =
            numbers->size() == 1 ? Vec3d((*numbers)[0]) : Vec3d((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    }
    if (is_srgb || value->value.starts_with('#'))
        color = Vec3d(linear_of_srgb(color->x), linear_of_srgb(color->y), linear_of_srgb(color->z));
    element.tag = "rgb";
    set_attribute(element, "value", fmt::format("{}, {}, {}", color->x, color->y, color->z));
    return true;
}

// <blackbody temperature="5000K" scale="2"/> as the spectrum of that name.
void blackbody_syntax(Element& element)
{
    std::string kelvin = element.value("temperature");
    if (kelvin.ends_with('K') || kelvin.ends_with('k')) kelvin.pop_back();
    const std::string scale = element.value("scale");
    element.children.push_back(made_parameter(element, "float", "temperature", kelvin));
    if (!scale.empty()) element.children.push_back(made_parameter(element, "float", "scale", scale));
    std::erase_if(element.attributes,
                  [](const Attribute& a) { return a.name == "temperature" || a.name == "scale"; });
    rename_tag(element, "spectrum");
    set_attribute(element, "type", "blackbody");
}

// uscale, vscale, uoffset and voffset as to_uv: u' = uscale u + uoffset.
bool uv_syntax(Element& texture, Diagnostics& diagnostics)
{
    double values[] = {1.0, 1.0, 0.0, 0.0};
    constexpr std::string_view names[] = {"uscale", "vscale", "uoffset", "voffset"};
    bool is_given = false, good = true;
    std::erase_if(texture.children, [&](const Element& child) {
        const auto name = std::find(std::begin(names), std::end(names), child.value("name"));
        const Attribute* value = child.attribute("value");
        if (name == std::end(names) || !value || (child.tag != "float" && child.tag != "integer"))
            return false;
        const auto number = read_number(child, *value, diagnostics);
        good = good && number;
        values[name - std::begin(names)] = number.value_or(0.0);
        is_given = true;
        return true;
    });
    if (!good || !is_given) return good;
    Element to_uv = made_object(texture, "transform", "");
    set_attribute(to_uv, "name", "to_uv");
    for (const auto& [tag, first, last] : {std::tuple("scale", 0, 1.0), std::tuple("translate", 2, 0.0)}) {
        Element operation = made_object(texture, tag, "");
        set_attribute(operation, "value", fmt::format("{}, {}, {}", values[first], values[first + 1], last));
        to_uv.children.push_back(std::move(operation));
    }
    texture.children.push_back(std::move(to_uv));
    return true;
}

bool syntax(Element& element, Diagnostics& diagnostics)
{
    if (element.tag == "texture" && !uv_syntax(element, diagnostics)) return false;
    if (const Attribute* name = element.attribute("name"); name && is_property_tag(element.tag))
        if (const std::string ours = snake_case(name->value); ours != name->value)
            rename_attribute_value(element, "name", ours);
    if (element.tag == "lookAt") rename_tag(element, "lookat");
    if (element.tag == "blackbody") blackbody_syntax(element);
    if (element.tag == "srgb" || element.tag == "rgb" || element.tag == "spectrum") {
        if (const Attribute* name = element.attribute("name"))
            if (const std::string ours = snake_case(name->value); ours != name->value)
                rename_attribute_value(element, "name", ours);
        if (!color_syntax(element, diagnostics)) return false;
    }
    if (element.tag == "texture" || element.tag == "ref")
        if (const Attribute* name = element.attribute("name"))
            if (const std::string ours = snake_case(name->value); ours != name->value)
                rename_attribute_value(element, "name", ours);
    return mitsuba_syntax(element, diagnostics);
}

// Distributions that Mitsuba 3 has no more are near Beckmann's.
bool known_distribution(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (!value || (value->value != "phong" && value->value != "as")) return true;
    diagnostics.warning(
        parameter.value_place(*value),
        fmt::format("the distribution '{}' is rendered as 'beckmann', which is near it", value->value));
    set_attribute(parameter, "value", "beckmann");
    return true;
}

// Ward's model has three normalisations; Plumb's is the one that keeps energy.
bool only_balanced(Element& parameter, Diagnostics& diagnostics)
{
    const Attribute* value = parameter.attribute("value");
    if (value && value->value != "balanced")
        diagnostics.warning(parameter.value_place(*value),
                            fmt::format("the variant '{}' is rendered as 'balanced'", value->value));
    return false;
}

// Filters of more than one texel need differentials of rays.
bool known_filter(Element& parameter, Diagnostics&)
{
    const std::string value = lower_case(parameter.value("value"));
    if (value == "ewa" || value == "trilinear") set_attribute(parameter, "value", "bilinear");
    return true;
}

// --- Tables ---------------------------------------------------------------------------------------------------

constexpr std::string_view near_diffuse = "this is rendered as 'diffuse'";

constexpr TypeName types[] = {
    {"integrator", "volpath_simple", "path_mis"},
    {"integrator", "adaptive", "adaptive",
     "the integrator inside it is rendered, with as many samples everywhere"},
    {"integrator", "irrcache", "irrcache",
     "the integrator inside it is rendered, which finds the same light up to noise"},
    {"integrator", "erpt", "path_mis", "this is rendered by 'path', which finds the same light up to noise"},
    {"film", "ldrfilm", "hdrfilm"},
    {"sampler", "sobol", "sobol"},
    {"sampler", "halton", "sobol"},
    {"sampler", "hammersley", "sobol"},
    {"bsdf", "roughdiffuse", "diffuse", near_diffuse},
    {"bsdf", "difftrans", "diffuse", near_diffuse},
    {"bsdf", "phong", "phong"},
    {"bsdf", "ward", "ward"},
    {"bsdf", "mixturebsdf", "mixture"},
    {"bsdf", "coating", "coating"},
    {"bsdf", "roughcoating", "coating", "this is rendered as 'coating', whose surface is smooth"},
};

constexpr ParamName params[] = {
    {"integrator", "adaptive", "*", ""}, // their child takes their place
    {"integrator", "irrcache", "*", ""},
    {"bsdf", "diffuse", "diffuse_reflectance", "albedo", color_of_reflectance},
    {"bsdf", "roughdiffuse", "reflectance", "albedo", color_of_reflectance},
    {"bsdf", "roughdiffuse", "diffuse_reflectance", "albedo", color_of_reflectance},
    {"bsdf", "difftrans", "transmittance", "albedo", color_of_reflectance},
    {"bsdf", "phong", "diffuse_reflectance", "diffuse-coefficients", color_of_reflectance},
    {"bsdf", "phong", "specular_reflectance", "specular-coefficients", color_of_reflectance},
    {"bsdf", "phong", "exponent", "exponent", to_number},
    {"bsdf", "ward", "variant", "", only_balanced},
    {"bsdf", "mixturebsdf", "weights", "weights"},
    {"bsdf", "coating", "thickness", "thickness"},
    {"bsdf", "coating", "sigma_a", "sigmaA", color_of_index},
    {"bsdf", "roughcoating", "thickness", "thickness"},
    {"bsdf", "roughcoating", "sigma_a", "sigmaA", color_of_index},
    {"bsdf", "conductor", "ext_eta", "extIOR", index_by_name},
    {"bsdf", "roughconductor", "ext_eta", "extIOR", index_by_name},
    {"bsdf", "", "distribution", "distribution", known_distribution},
    {"texture", "bitmap", "filter_type", "filter", known_filter},
};

// Conductors are of copper.
constexpr Preset presets[] = {
    {"bsdf", "conductor", "string", "material", "Cu", "eta"},
    {"bsdf", "roughconductor", "string", "material", "Cu", "eta"},
    {"bsdf", "phong", "color", "diffuse-coefficients", "0.5 0.5 0.5"},
    {"bsdf", "phong", "color", "specular-coefficients", "0.2 0.2 0.2"},
    {"bsdf", "phong", "float", "exponent", "30"},
};

constexpr Refusal refusals[] = {
    {"emitter", "sun", "use 'directional', or tools/bake_sky"},
    {"emitter", "collimated", "use 'spot' with a small cutoffAngle"},
    {"texture", "scale", "scale the image itself"},
    {"texture", "vertexcolors", "export the mesh as .ply and use 'mesh_attribute'"},
};

constexpr Ignored ignored[] = {
    {"film", "", "attach_log"},
    {"film", "", "gamma"},
    {"film", "", "high_quality_edges"},
    {"film", "", "exposure"},
    {"film", "", "tonemap_method"},
    {"film", "", "key"},
    {"film", "", "burn"},
    {"integrator", "", "strict_normals"},
    {"sampler", "", "scramble"},
    {"sampler", "", "dimension"},
    {"bsdf", "roughdiffuse", "alpha"},
    {"bsdf", "roughdiffuse", "use_fast_approx"},
    {"bsdf", "coating", "specular_sampling_weight"},
    {"bsdf", "roughcoating", "specular_sampling_weight"},
    {"bsdf", "roughcoating", "alpha"},
    {"bsdf", "roughcoating", "distribution"},
    {"bsdf", "ward", "specular_sampling_weight"},
    {"bsdf", "phong", "specular_sampling_weight"},
    {"texture", "bitmap", "max_anisotropy"},
    {"texture", "bitmap", "cache"},
    {"shape", "", "max_smooth_angle",
     "maxSmoothAngle is not read: the mesh is smooth, or flat with faceNormals"},
    {"camera", "", "kc"},
};

} // namespace

std::string snake_case(std::string_view name)
{
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (i > 0 && is_upper(name[i]) && is_lower(name[i - 1])) text += '_';
        text += lower_case(name[i]);
    }
    return text;
}

Vocabulary mitsuba06_vocabulary(const Vocabulary& base)
{
    return {.name = "mitsuba06",
            .types = types,
            .params = params,
            .presets = presets,
            .refusals = refusals,
            .ignored = ignored,
            .complete = true,
            .syntax = syntax,
            .base = &base};
}

} // namespace plumb
