// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/surface.h"
#include "plumb/model/texture.h"
#include "textures/two_colors.h"

namespace plumb {

/// Squares in two alternating colours, scalex by scaley of them over the unit square of uv.
///
/// The colour is `color1` where floor(u scalex) + floor(v scaley) is even and `color2` elsewhere, for negative u and
/// v too. The parameter `color`, which the Zaragoza course reads for both colours, sets both.
///
///     scalex   float   squares per unit of u   (default 1)
///     scaley   float   squares per unit of v   (default 1)
///     color1   color   of the square that begins at uv = (0, 0), and every second one   (default 0.9)
///     color2   color   of the others   (default 0.1)
///     color    color   both colours at once   (default: none)
///
/// For example:
///
///         <texture type="checker" name="albedo">
///             <integer name="scalex" value="10"/>
///             <integer name="scaley" value="10"/>
///             <color name="color2" value="0.2 0.2 0.4"/>
///         </texture>
class Checker final : public Texture {
public:
    explicit Checker(const Params& p)
        : scale_(p.number("scalex", 1.f, Range::positive()), p.number("scaley", 1.f, Range::positive()))
    {
        // As in the course: one parameter that both colours are read from.
        const bool both = p.has("color");
        const Color color = p.color("color", Color(0.f));
        if (both)
            p.warn("color",
                   "'color' sets both colours of a checker, which then shows no squares; use 'color1' and "
                   "'color2'");
        colors_.first = p.color("color1", both ? color : Color(0.9f));
        colors_.second = p.color("color2", both ? color : Color(0.1f));
    }

    Color mean() const override { return colors_.mean(0.0, scale_.x, 0.0, scale_.y); }
    float min_value() const override { return colors_.min_value(); }
    float max_value() const override { return colors_.max_value(); }

private:
    Color color_at(const SurfacePoint& at) const override
    {
        return colors_.at(at.uv.x * scale_.x, at.uv.y * scale_.y);
    }

    TwoColors colors_;
    Vec2f scale_;
};

template std::unique_ptr<Texture> build<Checker>(const Params&);

} // namespace plumb
