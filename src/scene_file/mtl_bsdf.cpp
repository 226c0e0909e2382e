// SPDX-License-Identifier: MIT
#include "scene_file/mtl_bsdf.h"

#include "scene_file/vocabulary.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include <fmt/format.h>

namespace plumb {

namespace {

class Maker {
public:
    Maker(const MtlMaterial& material, const Element& at, const std::filesystem::path& directory)
        : m_(material), at_(at), directory_(directory)
    {}

    MtlBsdf run()
    {
        if (!m_.emission.is_black()) remark("Ke is not used; an <emitter> inside the mesh emits");
        Element bsdf = is_glass() ? glass() : surface();
        if (auto map = texture("normal", m_.normal_map, true)) {
            bsdf = around("normalmap", std::move(bsdf), *std::move(map));
        } else if (auto bump = texture("height", m_.bump_map, true)) {
            remark("the height of a bump map is in units of the scene, times -bm");
            bsdf = around("bumpmap", std::move(bsdf), *std::move(bump));
            add(bsdf, "float", "scale", fmt::format("{}", m_.bump_map.bump));
        }
        if (auto map = texture("opacity", m_.dissolve_map, true)) {
            bsdf = around("mask", std::move(bsdf), *std::move(map));
        } else if (m_.dissolve < 1.f && !is_glass()) {
            Element opacity = made_parameter(at_, "float", "opacity", fmt::format("{}", m_.dissolve));
            bsdf = around("mask", std::move(bsdf), std::move(opacity));
        }
        return {std::move(bsdf), std::move(remarks_)};
    }

private:
    // The illumination models of the MTL format that refract.
    bool is_glass() const
    {
        return (m_.illumination == 4 || m_.illumination == 6 || m_.illumination == 7 ||
                m_.illumination == 9) &&
               m_.index >= 0.01f && m_.index <= 100.f;
    }
    // Those that reflect like a mirror.
    bool is_mirror() const
    {
        return (m_.illumination == 3 || m_.illumination == 5 || m_.illumination == 8) &&
               m_.diffuse.is_black() && m_.diffuse_map.file.empty() && !m_.specular.is_black();
    }
    bool is_physical() const
    {
        return m_.roughness > 0.f || m_.metallic > 0.f || m_.sheen > 0.f || m_.clearcoat > 0.f ||
               !m_.roughness_map.file.empty() || !m_.metallic_map.file.empty();
    }

    Element glass()
    {
        Element bsdf = made_object(at_, "bsdf", "dielectric");
        add(bsdf, "float", "intIOR", fmt::format("{}", m_.index));
        add(bsdf, "float", "extIOR", "1");
        if (!m_.transmittance.is_black()) add(bsdf, "specularTransmittance", m_.transmittance);
        return bsdf;
    }

    Element surface()
    {
        if (is_physical()) return principled();
        if (is_mirror()) {
            Element bsdf = made_object(at_, "bsdf", "conductor");
            add(bsdf, "specularReflectance", m_.specular);
            return bsdf;
        }
        const bool is_glossy = !m_.specular.is_black() && m_.exponent > 0.f && m_.illumination != 1;
        if (is_glossy) return exists(m_.diffuse_map) ? glossy_image() : phong();
        Element bsdf = made_object(at_, "bsdf", "diffuse");
        add_base(bsdf, "albedo");
        return bsdf;
    }

    Element principled()
    {
        Element bsdf = made_object(at_, "bsdf", "principled");
        add_base(bsdf, "baseColor");
        add_fraction(bsdf, "roughness", m_.roughness, &m_.roughness_map);
        add_fraction(bsdf, "metallic", m_.metallic, &m_.metallic_map);
        add_fraction(bsdf, "sheen", m_.sheen);
        add_fraction(bsdf, "clearcoat", m_.clearcoat);
        add_fraction(bsdf, "clearcoatGloss", 1.f - std::min(m_.clearcoat_roughness, 1.f));
        add_fraction(bsdf, "anisotropic", m_.anisotropy);
        return bsdf;
    }

    Element phong()
    {
        if (!m_.diffuse_map.file.empty()) remark_missing(m_.diffuse_map);
        remark("Kd, Ks and Ns become 'phong'");
        Element bsdf = made_object(at_, "bsdf", "phong");
        add(bsdf, "diffuse-coefficients", m_.diffuse);
        add(bsdf, "specular-coefficients", m_.specular);
        add(bsdf, "integer", "exponent", std::to_string(std::lround(m_.exponent)));
        return bsdf;
    }

    // A microfacet slope that falls off like the cosine's power: [Walter et al. 2007], section 5.2.
    Element glossy_image()
    {
        remark("map_Kd, Ks and Ns become 'roughplastic', whose highlight follows Fresnel's equations instead "
               "of Ks");
        Element bsdf = made_object(at_, "bsdf", "roughplastic");
        add_base(bsdf, "diffuseReflectance");
        add(bsdf, "float", "alpha", fmt::format("{}", std::min(std::sqrt(2.f / (m_.exponent + 2.f)), 1.f)));
        return bsdf;
    }

    void add_base(Element& bsdf, const char* name)
    {
        if (auto map = texture(name, m_.diffuse_map, false))
            bsdf.children.push_back(*std::move(map));
        else
            add(bsdf, name, m_.diffuse);
    }

    void add_fraction(Element& bsdf, const char* name, float value, const MtlMap* map = nullptr)
    {
        auto image = map ? texture(name, *map, true) : std::nullopt;
        if (image)
            bsdf.children.push_back(*std::move(image));
        else
            add(bsdf, "float", name, fmt::format("{}", std::min(value, 1.f)));
    }

    bool exists(const MtlMap& map) const
    {
        std::error_code status;
        return !map.file.empty() && std::filesystem::is_regular_file(directory_ / map.file, status);
    }

    void remark_missing(const MtlMap& map) { remark(fmt::format("there is no image '{}'", map.file)); }

    std::optional<Element> texture(const char* name, const MtlMap& map, bool raw)
    {
        if (map.file.empty()) return {};
        if (!exists(map)) {
            remark_missing(map);
            return {};
        }
        const std::filesystem::path file = directory_ / map.file;
        Element texture = made_object(at_, "texture", "bitmap");
        set_attribute(texture, "name", name);
        add(texture, "string", "filename", std::filesystem::absolute(file).string());
        if (raw) add(texture, "boolean", "raw", "true");
        const bool can_scale = map.scale.x != 0.f && map.scale.y != 0.f;
        if (can_scale && (map.scale != Vec3f(1.f) || map.offset != Vec3f(0.f))) {
            Element to_uv = made_object(at_, "transform", "");
            set_attribute(to_uv, "name", "toUv");
            Element scale = made_object(at_, "scale", ""), move = made_object(at_, "translate", "");
            set_attribute(scale, "value", fmt::format("{} {} 1", map.scale.x, map.scale.y));
            set_attribute(move, "value", fmt::format("{} {} 0", map.offset.x, map.offset.y));
            to_uv.children = {std::move(scale), std::move(move)};
            texture.children.push_back(std::move(to_uv));
        }
        return texture;
    }

    Element around(const char* type, Element bsdf, Element parameter)
    {
        Element outer = made_object(at_, "bsdf", type);
        outer.children.push_back(std::move(parameter));
        outer.children.push_back(std::move(bsdf));
        return outer;
    }

    void add(Element& element, const char* tag, const char* name, const std::string& value)
    {
        element.children.push_back(made_parameter(at_, tag, name, value));
    }

    // A colour of what scatters, which is at most 1.
    void add(Element& element, const char* name, const Color& color)
    {
        const auto limited = [](float c) { return std::min(c, 1.f); };
        add(element, "color", name,
            fmt::format("{} {} {}", limited(color[0]), limited(color[1]), limited(color[2])));
    }

    void remark(std::string text) { remarks_.push_back(std::move(text)); }

    const MtlMaterial& m_;
    const Element& at_;
    const std::filesystem::path& directory_;
    std::vector<std::string> remarks_;
};

} // namespace

MtlBsdf bsdf_of_mtl(const MtlMaterial& material, const Element& at, const std::filesystem::path& directory)
{
    return Maker(material, at, directory).run();
}

} // namespace plumb
