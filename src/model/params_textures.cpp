// SPDX-License-Identifier: MIT
// Parameters that a texture may replace.

#include "plumb/model/params.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumb {

namespace {

// Whether every value of the texture is in range; if not, the value that is not.
std::optional<float> value_outside(const Texture& texture, const Range& range)
{
    if (!range.contains(static_cast<double>(texture.min_value()))) return texture.min_value();
    if (!range.contains(static_cast<double>(texture.max_value()))) return texture.max_value();
    return {};
}

} // namespace

const TextureChild* Params::find_texture(std::string_view name) const
{
    const auto found = std::find_if(textures_.begin(), textures_.end(),
                                    [&](const TextureChild& child) { return child.name == name; });
    if (found == textures_.end()) return nullptr;
    found->asked = true;
    return &*found;
}

std::shared_ptr<const Texture> Params::texture(std::string_view name, const Color& fallback,
                                               Range range) const
{
    if (const auto child = texture_child(name, range)) return child;
    return std::make_shared<UniformTexture>(color(name, fallback, range));
}

std::shared_ptr<const Texture> Params::scalar_texture(std::string_view name, float fallback,
                                                      Range range) const
{
    if (const auto child = texture_child(name, range)) return child;
    return std::make_shared<UniformTexture>(Color(number(name, fallback, range)));
}

std::shared_ptr<const Texture> Params::texture_child(std::string_view name, const Range& range) const
{
    const TextureChild* child = find_texture(name);
    if (!child) return nullptr;
    if (find(name)) {
        diagnostics_.error(child->at,
                           fmt::format("{} is given twice, as a value and as a texture", as_written(name)));
        return nullptr;
    }
    if (!child->texture) return nullptr;
    if (const auto outside = value_outside(*child->texture, range)) {
        diagnostics_.error(child->at, fmt::format("{} must be {} everywhere, but the texture reaches {}",
                                                  as_written(name), range.text(), *outside));
        return nullptr;
    }
    return child->texture;
}

} // namespace plumb
