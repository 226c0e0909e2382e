// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/shape.h"
#include "plumb/model/texture.h"

namespace plumb {

/// What a mesh file gives for its vertices or faces, such as the colours of a scan.
///
/// Values of vertices are interpolated linearly over triangles. Values are limited to [0, 1]. Where the shape has no such
/// attribute the texture is 0.
///
///     attribute   string   vertex_NAME or face_NAME, after the properties NAME_0, NAME_1, ... of a PLY file
///
///         <texture type="meshattribute" name="albedo">
///             <string name="attribute" value="vertex_color"/>
///         </texture>
class MeshAttributeTexture final : public Texture {
public:
    explicit MeshAttributeTexture(const Params& p) : name_(p.string("attribute"))
    {
        if (!name_.empty() && !name_.starts_with("vertex_") && !name_.starts_with("face_"))
            p.fail("attribute", "must begin with 'vertex_' or 'face_', not '" + name_ + "'");
    }

    Color mean() const override { return Color(0.5f); } // not known: shapes have it
    float min_value() const override { return 0.f; }
    float max_value() const override { return 1.f; }
    bool reads_attributes() const override { return true; }

private:
    Color color_at(const SurfacePoint& at) const override
    {
        const auto value = at.shape ? at.shape->attribute(name_, at) : std::nullopt;
        if (!value) return Color(0.f);
        return {std::clamp(value->r, 0.f, 1.f), std::clamp(value->g, 0.f, 1.f),
                std::clamp(value->b, 0.f, 1.f)};
    }

    std::string name_;
};

template std::unique_ptr<Texture> build<MeshAttributeTexture>(const Params&);

} // namespace plumb
