// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/surface.h"
#include "plumb/model/texture.h"
#include "textures/two_colors.h"

#include <fmt/format.h>

namespace plumb {

/// Rectangles of a given size in two alternating values: colours, or numbers in `checkerboard_float`.
///
/// With i = floor(u / scale.x - delta.x) and j = floor(v / scale.y - delta.y), the texture is `value1` where i + j
/// is even and `value2` elsewhere.
///
///     value1   color or float   the value of the rectangle that begins at uv = scale delta   (default 0)
///     value2   color or float   the value of the rectangles beside it   (default 1)
///     scale    vector of 2      the size of a rectangle in uv   (default 1, 1)
///     delta    point of 2       how far the rectangles are shifted, in rectangles   (default 0, 0)
///
/// For example:
///
///         <texture type="checkerboard_color" name="albedo">
///             <color name="value1" value="0.8 0.8 0.8"/>
///             <color name="value2" value="0.2 0.2 0.2"/>
///             <vector name="scale" value="0.1 0.2"/>
///             <point name="delta" value="0.5 0.5"/>
///         </texture>
class Checkerboard final : public Texture {
public:
    explicit Checkerboard(const Params& p)
        : scale_(p.vector2("scale", Vec2f(1.f))), delta_(p.vector2("delta", Vec2f(0.f)))
    {
        if (!(scale_.x > 0.f && scale_.y > 0.f)) {
            p.fail("scale", fmt::format("must be greater than 0 in both, not {} {}", scale_.x, scale_.y));
            scale_ = Vec2f(1.f);
        }
        const auto value = [&p](const char* name, float fallback) {
            const bool is_color = p.type() != "checkerboard_float";
            return is_color ? p.color(name, Color(fallback))
                            : Color(p.number(name, fallback, Range::at_least(0.0)));
        };
        colors_.first = value("value1", 0.f);
        colors_.second = value("value2", 1.f);
    }

    Color mean() const override
    {
        const Vec2f begin = -delta_;
        const Vec2f end = Vec2f(1.f) / scale_ - delta_;
        return colors_.mean(begin.x, end.x, begin.y, end.y);
    }

    float min_value() const override { return colors_.min_value(); }
    float max_value() const override { return colors_.max_value(); }

private:
    Color color_at(const SurfacePoint& at) const override
    {
        return colors_.at(at.uv.x / scale_.x - delta_.x, at.uv.y / scale_.y - delta_.y);
    }

    TwoColors colors_;
    Vec2f scale_;
    Vec2f delta_;
};

template std::unique_ptr<Texture> build<Checkerboard>(const Params&);

} // namespace plumb
