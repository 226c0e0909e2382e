// SPDX-License-Identifier: MIT

#include "bsdfs/bent_normal.h"
#include "model/plugin.h"
#include "plumb/model/texture.h"

namespace plumb {

/// Bends the normal of the BSDF inside it, as a texture of normals says.
///
/// The colours of the texture are (n + 1) / 2 for a normal n: red along dp/du, blue along the normal of the surface, green
/// at right angles to both. Such images are linear, not sRGB. Blue below 0.5 points into the surface and counts as just
/// above 0.5.
///
/// Light is scattered only where it is on the same side of the bent normal as of the surface, so that none leaks
/// through.
///
///     normal               color or texture   (n + 1) / 2                                                         (default 0.5 0.5 1: as the surface)
///     useShadowing         boolean            soften where light on tilted normals ends ([Estevez et al. 2019])   (default false)
///     flipInvalidNormals   boolean            mirror normals that turn away from the viewer; else black there     (default true)
///
///         <bsdf type="normalmap">
///             <color name="normal" value="0.7 0.4 0.9"/>
///             <bsdf type="diffuse"/>
///         </bsdf>
///
///         <bsdf type="normalmap">
///             <texture type="checker" name="normal">
///                 <color name="color1" value="0.2 0.5 0.9"/>
///                 <color name="color2" value="0.5 0.9 0.8"/>
///             </texture>
///             <bsdf type="roughconductor">
///                 <float name="alpha" value="0.4"/>
///             </bsdf>
///         </bsdf>
class NormalMap final : public BentNormal {
public:
    explicit NormalMap(const Params& params)
        : BentNormal(params), normal_(params.color_texture("normal", Color(0.5f, 0.5f, 1.f), Range::any()))
    {}

private:
    Vec3f bent_normal(const SurfacePoint& at) const override
    {
        constexpr float lowest = 1e-3f;
        const Color c = normal_->color(at);
        return {2.f * c.r - 1.f, 2.f * c.g - 1.f, std::max(2.f * c.b - 1.f, lowest)};
    }

    std::shared_ptr<const ColorTexture> normal_;
};

template std::unique_ptr<Bsdf> build<NormalMap>(const Params&);

} // namespace plumb
