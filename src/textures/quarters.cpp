// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/surface.h"
#include "plumb/model/texture.h"
#include "textures/two_colors.h"
#include "textures/uv_map.h"

namespace plumb {

/// Two colours on alternating quarters of the unit square of uv, repeated.
///
/// The colour is `color0` where the fractions of u and v are both below 1/2 or both above, and `color1` elsewhere.
///
///     color0        color       of the quarter at uv = (0, 0) and the one opposite                           (default 0.4)
///     color1        color       of the others                                                                (default 0.2)
///     toUv          transform   acts on (u, v, 0) first                                                      (default: none)
///     swapNumbers   boolean     where the texture stands for a number, exchange the two, as Mitsuba 3 does   (default false)
///
///         <texture type="checkerboard" name="albedo">
///             <color name="color1" value="0.1 0.3 0.2"/>
///             <transform name="toUv">
///                 <scale value="4 4 1"/>
///             </transform>
///         </texture>
class Quarters final : public Texture {
public:
    explicit Quarters(const Params& p)
        : colors_{p.color("color0", Color(0.4f)), p.color("color1", Color(0.2f))}, numbers_{colors_}, map_(p)
    {
        if (p.boolean("swapNumbers", false)) std::swap(numbers_.first, numbers_.second);
    }

    Color mean() const override { return (colors_.first + colors_.second) * 0.5f; }
    float min_value() const override { return colors_.min_value(); }
    float max_value() const override { return colors_.max_value(); }

private:
    Color color_at(const SurfacePoint& at) const override { return look_up(colors_, at); }
    float number_at(const SurfacePoint& at) const override { return number_of(look_up(numbers_, at)); }

    Color look_up(const TwoColors& colors, const SurfacePoint& at) const
    {
        const Vec2f uv = map_(at.uv);
        return colors.at(2.f * uv.x, 2.f * uv.y);
    }

    TwoColors colors_;
    TwoColors numbers_;
    UvMap map_;
};

template std::unique_ptr<Texture> build<Quarters>(const Params&);

} // namespace plumb
