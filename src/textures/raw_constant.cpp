// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/texture.h"

namespace plumb {

/// The same three numbers everywhere, which may be negative: for data that is no colour, such as a normal.
///
///     value   vector, color or float   the value; a float stands for three equal ones   (default 0)
///
///         <texture type="rawconstant" name="albedo">
///             <vector name="value" value="0.5 0.25 1"/>
///         </texture>
class RawConstant final : public UniformTexture {
public:
    explicit RawConstant(const Params& p) : UniformTexture(p.raw_values("value", Color(0.f))) {}
};

template std::unique_ptr<Texture> build<RawConstant>(const Params&);

} // namespace plumb
