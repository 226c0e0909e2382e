// SPDX-License-Identifier: MIT
#pragma once

// The interface of textures: colours over a surface's uv coordinates.

#include "plumb/math/color.h"

namespace plumb {

// Conventions. uv as the shape defines it, not confined to [0, 1]. Linear light.
class Texture {
public:
    virtual ~Texture() = default;
    Color color(const Vec2f& uv) const { return uniform_ ? everywhere_ : color_at(uv); }

    // Scalar parameters (a roughness, say) read the luminance.
    float scalar(const Vec2f& uv) const { return luminance(color(uv)); }

    // The average over the unit square of uv; black only if the texture is black everywhere.
    virtual Color mean() const = 0;
    // Bounds of every channel over all uv.
    virtual float min_value() const = 0;
    virtual float max_value() const = 0;
    // Pixels of its image; 1 x 1 without one.
    virtual Vec2i resolution() const { return {1, 1}; }
    virtual std::uint64_t memory_bytes() const { return 0; } // of its picture, if it has one

protected:
    Texture() = default;
    explicit Texture(const Color& everywhere) : uniform_(true), everywhere_(everywhere) {}
    const Color& everywhere() const { return everywhere_; } // of a uniform texture

private:
    // Most textures are a single colour: those are read without a call.
    virtual Color color_at(const Vec2f& uv) const = 0;

    bool uniform_ = false;
    Color everywhere_;
};

class UniformTexture : public Texture {
public:
    explicit UniformTexture(const Color& color) : Texture(color) {}
    Color mean() const override { return everywhere(); }
    float min_value() const override { return min_component(everywhere()); }
    float max_value() const override { return max_component(everywhere()); }

private:
    Color color_at(const Vec2f&) const override { return everywhere(); }
};

} // namespace plumb
