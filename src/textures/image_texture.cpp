// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/surface.h"
#include "plumb/model/texture.h"
#include "textures/bitmap.h"

namespace plumb {

/// An image: its lower left corner at uv = (0, 0), its upper right corner at (1, 1), repeated.
///
/// Pixels are squares with their value in the middle: column u width - 1/2 and row (1 - v) height - 1/2, interpolated
/// bilinearly. Images of 8-bit or 16-bit integers are taken to be sRGB and decoded to linear light; floating-point
/// images are linear already.
///
///     filepath   string    the image: EXR, HDR, PNG, JPEG, BMP, TGA; with OpenImageIO any that it reads
///     raw        boolean   take integers as value / maximum, without decoding sRGB   (default false)
///
/// For example:
///
///         <texture type="imagetexture_color3f" name="albedo">
///             <string name="filepath" value="moon.jpg"/>
///         </texture>
class ImageTexture final : public Texture {
public:
    explicit ImageTexture(const Params& p) : bitmap_(p.file("filepath"), !p.boolean("raw", false), Color(1.f))
    {}

    Color mean() const override { return bitmap_.mean(); }
    float min_value() const override { return bitmap_.min_value(); }
    float max_value() const override { return bitmap_.max_value(); }
    Vec2i resolution() const override { return {bitmap_.width(), bitmap_.height()}; }
    std::uint64_t memory_bytes() const override { return bitmap_.memory_bytes(); }

private:
    Color color_at(const SurfacePoint& at) const override
    {
        const Vec2f place = place_in_image(at.uv);
        return bitmap_.bilinear(place.x, place.y, Bitmap::Wrap::repeat);
    }

    Vec2f slope(const SurfacePoint& at) const override
    {
        const Vec2f place = place_in_image(at.uv);
        const Vec2f by_texel = bitmap_.slope(place.x, place.y, Bitmap::Wrap::repeat);
        return {by_texel.x * static_cast<float>(bitmap_.width()),
                -by_texel.y * static_cast<float>(bitmap_.height())};
    }

    Vec2f place_in_image(const Vec2f& uv) const
    {
        return {uv.x * static_cast<float>(bitmap_.width()) - 0.5f,
                (1.f - uv.y) * static_cast<float>(bitmap_.height()) - 0.5f};
    }

    Bitmap bitmap_;
};

template std::unique_ptr<Texture> build<ImageTexture>(const Params&);

} // namespace plumb
