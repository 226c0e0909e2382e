// SPDX-License-Identifier: MIT
#include "scene_file/catalog.h"

#include "plumb/scene_file/scene_file.h"
#include "scene_file/manual.h"
#include "scene_file/nori_words.h"

#include <algorithm>
#include <list>

namespace plumb {

namespace {

constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::string_view name_characters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

} // namespace

// Type name in scene files, class, and the class's name for its manual page. The class is declared on the spot; its
// file instantiates build<> for it.

constexpr Entry<Shape> shapes[] = {
    {"obj", build<class ObjMesh>, "ObjMesh"},
    {"ply", build<class PlyMesh>, "PlyMesh"},
    {"serialized", build<class SerializedMesh>, "SerializedMesh"},
    {"sphere", build<class Sphere>, "Sphere"},
    {"rectangle", build<class Rectangle>, "Rectangle"},
    {"disk", build<class Disk>, "Disk"},
    {"cube", build<class Cube>, "Cube"},
    {"cylinder", build<class Cylinder>, "Cylinder"},
};

// Of the kind "shape" as well.
constexpr Entry<Composite> composites[] = {
    {"group", build<class GroupOfShapes>, "GroupOfShapes"},
    {"instance", build<class InstanceOfGroup>, "InstanceOfGroup"},
};

constexpr Entry<Bsdf> bsdfs[] = {
    {"diffuse", build<class Diffuse>, "Diffuse"},
    {"mirror", build<class Mirror>, "Mirror"},
    {"dielectric", build<class Dielectric>, "Dielectric"},
    {"microfacet", build<class Microfacet>, "Microfacet"},
    {"roughconductor", build<class RoughConductor>, "RoughConductor"},
    {"roughsubstrate", build<class RoughSubstrate>, "RoughSubstrate"},
    {"roughdielectric", build<class RoughDielectric>, "RoughDielectric"},
    {"phong", build<class Phong>, "Phong"},
    {"conductor", build<class Conductor>, "Conductor"},
    {"thindielectric", build<class ThinDielectric>, "ThinDielectric"},
    {"plastic", build<class Plastic>, "Plastic"},
    {"roughplastic", build<class RoughPlastic>, "RoughPlastic"},
    {"principled", build<class Principled>, "Principled"},
    {"principledthin", build<class PrincipledThin>, "PrincipledThin"},
    {"normalmap", build<class NormalMap>, "NormalMap"},
    {"bumpmap", build<class BumpMap>, "BumpMap"},
    {"twosided", build<class TwoSided>, "TwoSided"},
    {"mask", build<class Mask>, "Mask"},
    {"null", build<class NullBsdf>, "NullBsdf"},
    {"blend", build<class Blend>, "Blend"},
    {"mixture", build<class Mixture>, "Mixture"},
    {"ward", build<class Ward>, "Ward"},
    {"coating", build<class Coating>, "Coating"},
};

constexpr Entry<Texture> texture_entries[] = {
    {"checker", build<class Checker>, "Checker"},
    {"textmap", build<class TextMap>, "TextMap"},
    {"checkerboard_color", build<class Checkerboard>, "Checkerboard"},
    {"checkerboard_float", build<class Checkerboard>, "Checkerboard"},
    {"constant_color", build<class ConstantTexture>, "ConstantTexture"},
    {"constant_float", build<class ConstantTexture>, "ConstantTexture"},
    {"imagetexture_color3f", build<class ImageTexture>, "ImageTexture"},
    {"bitmap", build<class BitmapTexture>, "BitmapTexture"},
    {"checkerboard", build<class Quarters>, "Quarters"},
    {"rawconstant", build<class RawConstant>, "RawConstant"},
    {"meshattribute", build<class MeshAttributeTexture>, "MeshAttributeTexture"},
};

constexpr Entry<Emitter> emitters[] = {
    {"area", build<class AreaEmitter>, "AreaEmitter"},
    {"point", build<class PointEmitter>, "PointEmitter"},
    {"directional", build<class DirectionalEmitter>, "DirectionalEmitter"},
    {"environment", build<class EnvironmentEmitter>, "EnvironmentEmitter"},
    {"spot", build<class SpotEmitter>, "SpotEmitter"},
    {"projector", build<class ProjectorEmitter>, "ProjectorEmitter"},
};

constexpr Entry<Camera> cameras[] = {
    {"perspective", build<class PerspectiveCamera>, "PerspectiveCamera"},
    {"orthographic", build<class OrthographicCamera>, "OrthographicCamera"},
    {"spherical", build<class SphericalCamera>, "SphericalCamera"},
    {"fisheye", build<class FisheyeCamera>, "FisheyeCamera"},
};

constexpr Entry<Sampler> samplers[] = {
    {"independent", build<class IndependentSampler>, "IndependentSampler"},
    {"sobol", build<class SobolSampler>, "SobolSampler"},
    {"stratified", build<class StratifiedSampler>, "StratifiedSampler"},
};

constexpr Entry<Filter> filters[] = {
    {"gaussian", build<class GaussianFilter>, "GaussianFilter"},
    {"mitchell", build<class MitchellFilter>, "MitchellFilter"},
    {"tent", build<class TentFilter>, "TentFilter"},
    {"box", build<class BoxFilter>, "BoxFilter"},
    {"catmullrom", build<class CatmullRomFilter>, "CatmullRomFilter"},
    {"lanczos", build<class LanczosFilter>, "LanczosFilter"},
};

constexpr Entry<Integrator> integrators[] = {
    {"path", build<class Path>, "Path"},
    {"path_mats", build<class PathMats>, "PathMats"},
    {"path_nee", build<class PathNee>, "PathNee"},
    {"path_mis", build<class PathMis>, "PathMis"},
    {"direct", build<class Direct>, "Direct"},
    {"direct_ems", build<class DirectEms>, "DirectEms"},
    {"direct_mats", build<class DirectMats>, "DirectMats"},
    {"direct_mis", build<class DirectMis>, "DirectMis"},
    {"direct-mis", build<class DirectMisConfigured>, "DirectMisConfigured"},
    {"direct_whitted", build<class DirectWhitted>, "DirectWhitted"},
    {"whitted", build<class Whitted>, "Whitted"},
    {"normals", build<class NormalsIntegrator>, "NormalsIntegrator"},
    {"depth", build<class DepthIntegrator>, "DepthIntegrator"},
    {"ao", build<class AmbientOcclusion>, "AmbientOcclusion"},
    {"av", build<class AverageVisibility>, "AverageVisibility"},
    {"simple", build<class Simple>, "Simple"},
};

namespace {

// Plugins ignore some more by themselves, where they can say what to do instead.
constexpr IgnoredParameter ignored_parameters[] = {
    {"", "", "name", "", ""},
    {"", "", "id", "", ""},
    {"scene", "", "accelerator", "", ""},
    {"bsdf", "phong", "shininess", "exponent", "1"},
    {"bsdf", "phong", "specularCoef", "specular-coefficients", "1 1 1"},
    {"bsdf", "phong", "diffuseCoef", "diffuse-coefficients", "0 0 0"},
    {"integrator", "ao", "sampling", "", ""},
    {"integrator", "direct", "warp", "", ""},
    {"integrator", "direct-mis", "warp", "", ""},
    {"sampler", "independent", "iteration", "", ""},
};

// Texts for views; called while known_types() is made, once.
std::string_view kept_text(std::string text)
{
    static std::list<std::string> texts;
    return texts.emplace_back(std::move(text));
}

template <class Kind>
void append(std::vector<TypeInfo>& types, std::string_view kind, std::span<const Entry<Kind>> entries)
{
    for (const Entry<Kind>& entry : entries) {
        const std::string_view manual = plugin_source_manual(entry.class_name);
        types.push_back({kind, entry.name, manual});
        for (const TypeName& other : other_type_names())
            if (other.kind == kind && other.ours == entry.name)
                types.push_back({kind, other.theirs, kept_text(manual_of_other_name(other, manual))});
    }
}

std::vector<TypeInfo> all_types()
{
    std::vector<TypeInfo> types;
    append(types, "shape", shape_types());
    append(types, "shape", composite_types());
    append(types, "bsdf", bsdf_types());
    append(types, "texture", texture_types());
    append(types, "emitter", emitter_types());
    append(types, "camera", camera_types());
    append(types, "rfilter", filter_types());
    append(types, "sampler", sampler_types());
    append(types, "integrator", integrator_types());
    return types;
}

} // namespace

std::span<const Entry<Shape>> shape_types()
{
    return shapes;
}

std::span<const Entry<Composite>> composite_types()
{
    return composites;
}

std::span<const Entry<Bsdf>> bsdf_types()
{
    return bsdfs;
}

std::span<const Entry<Texture>> texture_types()
{
    return texture_entries;
}

std::span<const Entry<Emitter>> emitter_types()
{
    return emitters;
}

std::span<const Entry<Camera>> camera_types()
{
    return cameras;
}

std::span<const Entry<Sampler>> sampler_types()
{
    return samplers;
}

std::span<const Entry<Filter>> filter_types()
{
    return filters;
}

std::span<const Entry<Integrator>> integrator_types()
{
    return integrators;
}

const std::vector<TypeInfo>& known_types()
{
    static const std::vector<TypeInfo> types = all_types();
    return types;
}

std::string_view kind_of_tag(std::string_view tag)
{
    if (tag == "mesh") return "shape";
    for (const TypeInfo& type : known_types())
        if (type.kind == tag) return type.kind;
    return {};
}

std::string_view kind_of_type(std::string_view name)
{
    for (const TypeInfo& type : known_types())
        if (type.name == name) return type.kind;
    return {};
}

const IgnoredParameter* find_ignored(std::string_view kind, std::string_view type, std::string_view name)
{
    const auto found = std::find_if(
        std::begin(ignored_parameters), std::end(ignored_parameters), [&](const IgnoredParameter& entry) {
            return entry.name == name && (entry.kind.empty() || entry.kind == kind) &&
                   (entry.type.empty() || entry.type == type);
        });
    return found == std::end(ignored_parameters) ? nullptr : found;
}

namespace {

// The lines of a manual page that describe a parameter, without their indentation of exactly four blanks.
std::vector<std::string_view> parameter_lines(std::string_view manual)
{
    std::vector<std::string_view> lines;
    while (!manual.empty()) {
        const std::size_t end = std::min(manual.find('\n'), manual.size());
        const std::string_view line = manual.substr(0, end);
        manual.remove_prefix(std::min(end + 1, manual.size()));
        if (line.size() > 4 && line.substr(0, 4) == "    " && letters.find(line[4]) != letters.npos)
            lines.push_back(line.substr(4));
    }
    return lines;
}

std::string_view leading_word(std::string_view line)
{
    return line.substr(0, std::min(line.find_first_not_of(name_characters), line.size()));
}

} // namespace

std::vector<std::string_view> parameters_in(std::string_view manual)
{
    std::vector<std::string_view> names;
    for (const std::string_view line : parameter_lines(manual)) names.push_back(leading_word(line));
    return names;
}

std::vector<std::string_view> texture_parameters_of(std::string_view kind, std::string_view type)
{
    std::vector<std::string_view> names;
    for (const TypeInfo& info : known_types()) {
        if (info.kind != kind || info.name != type) continue;
        for (const std::string_view line : parameter_lines(info.manual)) {
            std::string_view rest = line.substr(leading_word(line).size());
            rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
            if (rest.starts_with("color or texture") || rest.starts_with("float or texture"))
                names.push_back(leading_word(line));
        }
    }
    return names;
}

} // namespace plumb
