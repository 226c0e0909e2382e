// SPDX-License-Identifier: MIT

#include "plumb/shapes/mtl.h"

#include "plumb/base/error.h"
#include "shapes/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tiny_obj_loader.h>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t largest_file = std::size_t{64} << 20;
constexpr float largest_number = 1e6f;

float number(tinyobj::real_t value)
{
    return std::isfinite(value) ? std::clamp(static_cast<float>(value), 0.f, largest_number) : 0.f;
}

float signed_number(tinyobj::real_t value)
{
    return std::isfinite(value) ? std::clamp(static_cast<float>(value), -largest_number, largest_number)
                                : 0.f;
}

Color color(const tinyobj::real_t (&c)[3])
{
    return {number(c[0]), number(c[1]), number(c[2])};
}

MtlMap map(const std::string& file, const tinyobj::texture_option_t& option)
{
    const auto vector = [](const tinyobj::real_t(&v)[3]) {
        return Vec3f(signed_number(v[0]), signed_number(v[1]), signed_number(v[2]));
    };
    MtlMap result{file, vector(option.scale), vector(option.origin_offset),
                  signed_number(option.bump_multiplier)};
    std::replace(result.file.begin(), result.file.end(), '\\', '/');
    while (result.file.ends_with(' ') || result.file.ends_with('\r')) result.file.pop_back();
    return result;
}

MtlMaterial material(const tinyobj::material_t& from)
{
    MtlMaterial m;
    m.name = from.name;
    m.diffuse = color(from.diffuse);
    m.specular = color(from.specular);
    m.transmittance = color(from.transmittance);
    m.emission = color(from.emission);
    m.exponent = number(from.shininess);
    m.index = number(from.ior);
    m.dissolve = std::min(number(from.dissolve), 1.f);
    m.illumination = from.illum;
    m.roughness = number(from.roughness);
    m.metallic = number(from.metallic);
    m.sheen = number(from.sheen);
    m.clearcoat = number(from.clearcoat_thickness);
    m.clearcoat_roughness = number(from.clearcoat_roughness);
    m.anisotropy = number(from.anisotropy);
    m.diffuse_map = map(from.diffuse_texname, from.diffuse_texopt);
    m.dissolve_map = map(from.alpha_texname, from.alpha_texopt);
    m.bump_map = map(from.bump_texname, from.bump_texopt);
    m.normal_map = map(from.normal_texname, from.normal_texopt);
    m.roughness_map = map(from.roughness_texname, from.roughness_texopt);
    m.metallic_map = map(from.metallic_texname, from.metallic_texopt);
    return m;
}

} // namespace

std::vector<MtlMaterial> read_mtl(const std::filesystem::path& path)
{
    const FileBytes text = read_file_bytes(path);
    if (text.size > largest_file)
        throw Error(fmt::format("cannot read '{}': it has {} MB; at most 64 are read", path.string(),
                                text.size >> 20));
    std::istringstream stream(std::string(text.bytes.get(), text.size));
    std::map<std::string, int> numbers;
    std::vector<tinyobj::material_t> read;
    std::string warnings, errors; // about keywords that are not used here either
    tinyobj::LoadMtl(&numbers, &read, &stream, &warnings, &errors);
    std::vector<MtlMaterial> materials;
    for (const tinyobj::material_t& one : read)
        if (!one.name.empty()) materials.push_back(material(one));
    return materials;
}

} // namespace plumb
