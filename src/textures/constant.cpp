// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/texture.h"

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
class ConstantTexture final : public UniformTexture {
public:
    explicit ConstantTexture(const Params& p)
        : UniformTexture(p.type() == "constant_float" ? Color(p.number("value", 0.f, Range::at_least(0.0)))
                                                      : p.color("value", Color(0.f)))
    {}
};

template std::unique_ptr<Texture> build<ConstantTexture>(const Params&);

} // namespace plumb
