// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/surface.h"
#include "plumb/model/texture.h"
#include "textures/bitmap.h"
#include "textures/uv_map.h"

namespace plumb {

/// An image over the unit square of uv.
///
/// Pixels are squares with their value in the middle: column u width - 1/2. With `vOrigin` "bottom" the image is upright:
/// row (1 - v) height - 1/2, counted from the top; with "top" its first row is at v = 0: row v height - 1/2. Images of
/// 8-bit or 16-bit integers are taken to be sRGB and decoded to linear light, also where they stand for numbers;
/// floating-point images are linear already. Read as a number, a colour is its luminance. An alpha channel is left out.
/// 8-bit images take 1 (grey) or 3 bytes a pixel of memory, others 12.
///
///     filename   string      the image: EXR, HDR, PNG, JPEG, BMP, TGA; with OpenImageIO any that it reads
///     raw        boolean     take integers as value / maximum, without decoding sRGB         (default false)
///     filter     string      bilinear or nearest                                             (default bilinear)
///     wrap       string      beyond the image: repeat, mirror (every second copy) or clamp   (default repeat)
///     vOrigin    string      where the first row of the image is: bottom or top, as above    (default bottom)
///     toUv       transform   acts on (u, v, 0) before the lookup                             (default: none)
///
///         <texture type="bitmap" name="albedo">
///             <string name="filename" value="wood.png"/>
///         </texture>
///
///         <texture type="bitmap" name="albedo">
///             <string name="filename" value="wood.png"/>
///             <boolean name="raw" value="true"/>
///             <string name="filter" value="nearest"/>
///             <string name="wrap" value="mirror"/>
///             <string name="vOrigin" value="top"/>
///             <transform name="toUv">
///                 <scale value="2 4 1"/>
///             </transform>
///         </texture>
class BitmapTexture final : public Texture {
public:
    explicit BitmapTexture(const Params& p)
        : bitmap_(p.file("filename"), !p.boolean("raw", false), Color(1.f)),
          nearest_(p.choice("filter", "bilinear", {"bilinear", "nearest"}) == "nearest"),
          wrap_(wrap_of(p.choice("wrap", "repeat", {"repeat", "mirror", "clamp"}))),
          upright_(p.choice("vOrigin", "bottom", {"bottom", "top"}) == "bottom"),
          map_(p)
    {}

    Color mean() const override { return bitmap_.mean(); } // of the whole image
    float min_value() const override { return bitmap_.min_value(); }
    float max_value() const override { return bitmap_.max_value(); }
    Vec2i resolution() const override { return {bitmap_.width(), bitmap_.height()}; }
    std::uint64_t memory_bytes() const override { return bitmap_.memory_bytes(); }

    Vec2f slope(const SurfacePoint& at) const override
    {
        if (nearest_) return Vec2f(0.f);
        const Vec2f place = place_in_image(at.uv);
        const Vec2f by_texel = bitmap_.slope(place.x, place.y, wrap_);
        const float rows = static_cast<float>(bitmap_.height());
        return map_.slope(
            Vec2f(by_texel.x * static_cast<float>(bitmap_.width()), by_texel.y * (upright_ ? -rows : rows)));
    }

private:
    static Bitmap::Wrap wrap_of(const std::string& word)
    {
        return word == "repeat"   ? Bitmap::Wrap::repeat
               : word == "mirror" ? Bitmap::Wrap::mirror
                                  : Bitmap::Wrap::clamp;
    }

    Vec2f place_in_image(const Vec2f& uv) const
    {
        const Vec2f mapped = map_(uv);
        const float down = upright_ ? 1.f - mapped.y : mapped.y;
        return {mapped.x * static_cast<float>(bitmap_.width()) - 0.5f,
                down * static_cast<float>(bitmap_.height()) - 0.5f};
    }

    Color color_at(const SurfacePoint& at) const override
    {
        const Vec2f place = place_in_image(at.uv);
        return nearest_ ? bitmap_.nearest(place.x, place.y, wrap_)
                        : bitmap_.bilinear(place.x, place.y, wrap_);
    }

    Bitmap bitmap_;
    bool nearest_;
    Bitmap::Wrap wrap_;
    bool upright_;
    UvMap map_;
};

template std::unique_ptr<Texture> build<BitmapTexture>(const Params&);

} // namespace plumb
