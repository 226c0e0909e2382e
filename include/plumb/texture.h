// SPDX-License-Identifier: MIT
#pragma once

// The interface of textures: colours over a surface's uv coordinates.

#include "plumb/color.h"

namespace plumb {

// Conventions. uv as the shape defines it, not confined to [0, 1]. Linear light.
class Texture {
public:
    virtual ~Texture() = default;
    virtual Color color(const Vec2f& uv) const = 0;

    // Scalar parameters (a roughness, say) read the luminance.
    float scalar(const Vec2f& uv) const { return luminance(color(uv)); }

    // The average over the unit square of uv; black only if the texture is black everywhere.
    virtual Color mean() const = 0;
    // Bounds of every channel over all uv.
    virtual float min_value() const = 0;
    virtual float max_value() const = 0;
};

} // namespace plumb
