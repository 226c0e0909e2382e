// SPDX-License-Identifier: MIT

#include "interfaces/plugin.h"
#include "plumb/texture.h"

namespace plumb {

/// The same value everywhere: a colour, or a number in `constant_float`.
///
///     value   color or float   the value   (default 0)
///
/// For example:
///
///         <texture type="constant_color" name="albedo">
///             <color name="value" value="0.3 0.5 0.2"/>
///         </texture>
class ConstantTexture final : public Texture {
public:
    explicit ConstantTexture(const Params& p)
        : value_(p.type() == "constant_float" ? Color(p.number("value", 0.f, Range::at_least(0.0)))
                                              : p.color("value", Color(0.f)))
    {}

    Color color(const Vec2f&) const override { return value_; }
    Color mean() const override { return value_; }
    float min_value() const override { return min_component(value_); }
    float max_value() const override { return max_component(value_); }

private:
    Color value_;
};

template std::unique_ptr<Texture> build<ConstantTexture>(const Params&);

} // namespace plumb
