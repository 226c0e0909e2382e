// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/surface.h"
#include "plumb/model/texture.h"
#include "textures/bitmap.h"

#include <fmt/format.h>

namespace plumb {

/// An image, looked up as the Zaragoza course does: against u and v, and without decoding sRGB.
///
/// The texel at column x = (1 - u) width and row y = (1 - v) height, counted from the upper left corner, where texel
/// (i, j) stands at x = i and y = j; in between it is interpolated bilinearly, and it repeats. Integers become value /
/// maximum. To show photographs in their true colours, use `imagetexture_color3f`.
///
///     filename   string   the image: EXR, HDR, PNG, JPEG, BMP, TGA; with OpenImageIO any that it reads
///     color      color    multiplies the image   (default 1)
///     scalex     float    read and not used, as in the course; other values than 1 give a warning   (default 1)
///     scaley     float    the same   (default 1)
///
/// For example:
///
///         <texture type="textmap" name="albedo">
///             <string name="filename" value="textures/wood.png"/>
///         </texture>
class TextMap final : public Texture {
public:
    explicit TextMap(const Params& p) : bitmap_(p.file("filename"), false, p.color("color", Color(1.f)))
    {
        for (const char* name : {"scalex", "scaley"})
            if (p.number(name, 1.f) != 1.f)
                p.warn(name,
                       fmt::format(
                           "'{}' of a textmap has no effect, as in the course's renderer; scale the mesh's "
                           "texture coordinates",
                           name));
    }

    Color mean() const override { return bitmap_.mean(); }
    float min_value() const override { return bitmap_.min_value(); }
    float max_value() const override { return bitmap_.max_value(); }
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
        return -bitmap_.slope(place.x, place.y, Bitmap::Wrap::repeat) * size();
    }

    Vec2f size() const { return {static_cast<float>(bitmap_.width()), static_cast<float>(bitmap_.height())}; }
    Vec2f place_in_image(const Vec2f& uv) const { return (Vec2f(1.f) - uv) * size(); }

    Bitmap bitmap_;
};

template std::unique_ptr<Texture> build<TextMap>(const Params&);

} // namespace plumb
