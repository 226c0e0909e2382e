// SPDX-License-Identifier: MIT
#pragma once

// The interfaces of textures: colours and numbers over a surface.

#include "plumb/math/color.h"

#include <cstdint>

namespace plumb {

struct SurfacePoint;

// Conventions. Textures read uv as the shape defines it, not confined to [0, 1]; those that are attributes of a mesh read
// the triangle, too. Linear light.
class ColorTexture {
public:
    virtual ~ColorTexture() = default;
    Color color(const SurfacePoint& at) const { return is_uniform_ ? everywhere_ : color_at(at); }
    // Where only uv is known. Not for textures that read attributes of a mesh, which are black there.
    Color color(const Vec2f& uv) const { return is_uniform_ ? everywhere_ : color_at_uv(uv); }

    // The average over the unit square of uv; black only if the texture is black everywhere.
    virtual Color mean() const = 0;
    // Bounds of every channel over all uv.
    virtual float min_value() const = 0;
    virtual float max_value() const = 0;
    // Pixels of its image; 1 x 1 without one.
    virtual Vec2i resolution() const { return {1, 1}; }
    virtual bool reads_attributes() const { return false; } // of a mesh

protected:
    ColorTexture() = default;
    explicit ColorTexture(const Color& everywhere) : is_uniform_(true), everywhere_(everywhere) {}
    const Color& everywhere() const { return everywhere_; } // of a uniform texture

private:
    // Most textures are a single colour: those are read without a call.
    virtual Color color_at(const SurfacePoint& at) const = 0;
    Color color_at_uv(const Vec2f& uv) const;

    bool is_uniform_ = false;
    Color everywhere_;
};

class NumberTexture {
public:
    virtual ~NumberTexture() = default;
    float number(const SurfacePoint& at) const { return is_uniform_ ? everywhere_ : number_at(at); }
    float number(const Vec2f& uv) const { return is_uniform_ ? everywhere_ : number_at_uv(uv); }
    // The derivatives of the number by u and v; 0 where it jumps.
    virtual Vec2f slope(const SurfacePoint& at) const;

    virtual float min_number() const = 0;
    virtual float max_number() const = 0;

protected:
    NumberTexture() = default;
    explicit NumberTexture(float everywhere) : is_uniform_(true), everywhere_(everywhere) {}

private:
    virtual float number_at(const SurfacePoint& at) const = 0;
    float number_at_uv(const Vec2f& uv) const;

    bool is_uniform_ = false;
    float everywhere_ = 0.f;
};

// A colour read as a number: its luminance, and of greys exactly their value.
constexpr float number_of(const Color& c)
{
    return c.r == c.g && c.g == c.b ? c.r : luminance(c);
}

// A texture of a scene file, which serves as either. Read as a number it is number_of its colour unless it says otherwise.
class Texture : public ColorTexture, public NumberTexture {
public:
    float min_number() const override { return min_value(); }
    float max_number() const override { return max_value(); }
    virtual std::uint64_t memory_bytes() const { return 0; } // of its image, if it has one

protected:
    Texture() = default;
    explicit Texture(const Color& everywhere) : ColorTexture(everywhere), NumberTexture(number_of(everywhere))
    {}

private:
    float number_at(const SurfacePoint& at) const override { return number_of(color(at)); }
};

class UniformTexture : public Texture {
public:
    explicit UniformTexture(const Color& color) : Texture(color) {}
    Color mean() const override { return everywhere(); }
    float min_value() const override { return min_component(everywhere()); }
    float max_value() const override { return max_component(everywhere()); }

private:
    Color color_at(const SurfacePoint&) const override { return everywhere(); }
};

} // namespace plumb
