// SPDX-License-Identifier: MIT
// Parameters that a texture may replace.

#include "plumb/model/params.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

const TextureChild* Params::find_texture(std::string_view name) const
{
    const auto found = std::find_if(textures_.begin(), textures_.end(),
                                    [&](const TextureChild& child) { return child.name == name; });
    if (found == textures_.end()) return nullptr;
    found->asked = true;
    return &*found;
}

std::shared_ptr<const ColorTexture> Params::color_texture(std::string_view name, const Color& fallback,
                                                          Range range) const
{
    const auto child = texture_child(name);
    if (child && !reject_outside(name, range, child->min_value(), child->max_value())) return child;
    return std::make_shared<UniformTexture>(child ? fallback : color(name, fallback, range));
}

std::shared_ptr<const NumberTexture> Params::number_texture(std::string_view name, float fallback,
                                                            Range range) const
{
    const auto child = texture_child(name);
    if (child && !reject_outside(name, range, child->min_number(), child->max_number())) return child;
    return std::make_shared<UniformTexture>(Color(child ? fallback : number(name, fallback, range)));
}

std::string Params::only_texture(std::string_view name) const
{
    if (textures_.size() != 1) return std::string(name);
    const std::string& only = textures_.front().name;
    return std::find(asked_.begin(), asked_.end(), only) == asked_.end() ? only : std::string(name);
}

std::shared_ptr<const Texture> Params::texture_child(std::string_view name) const
{
    const TextureChild* child = find_texture(name);
    if (!child) return nullptr;
    if (find(name)) {
        diagnostics_.error(child->at,
                           fmt::format("{} is given twice, as a value and as a texture", as_written(name)));
        return nullptr;
    }
    return child->texture;
}

// Whether a value of the texture is out of range, which is reported.
bool Params::reject_outside(std::string_view name, const Range& range, float smallest, float largest) const
{
    const bool too_small = !range.contains(static_cast<double>(smallest));
    if (!too_small && range.contains(static_cast<double>(largest))) return false;
    diagnostics_.error(find_texture(name)->at,
                       fmt::format("{} must be {} everywhere, but the texture reaches {}", as_written(name),
                                   range.text(), too_small ? smallest : largest));
    return true;
}

} // namespace plumb
