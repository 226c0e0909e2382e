// SPDX-License-Identifier: MIT

// [1] Blinn 1978, "Simulation of Wrinkled Surfaces".

#include "bsdfs/bent_normal.h"
#include "model/plugin.h"
#include "plumb/model/shape.h"
#include "plumb/model/texture.h"

namespace plumb {

/// Bends the normal of the BSDF inside it as if the surface rose by a texture's number.
///
/// The bent normal is (dp/du + n dh/du) x (dp/dv + n dh/dv) ([Blinn 1978]), on the front side, where h is `scale` times the
/// texture read as a number, in units of the scene. The slope of an image is that of its bilinear interpolation. Elsewhere it
/// is 0 between jumps. The texture is the only one inside the BSDF and may have any name.
///
/// Light is scattered only where it is on the same side of the bent normal as of the surface, so that none leaks
/// through.
///
///     height               float or texture   how far the surface rises                                           (default 0)
///     scale                float              multiplies the height, in units of the scene                        (default 1)
///     useShadowing         boolean            soften where light on tilted normals ends ([Estevez et al. 2019])   (default false)
///     flipInvalidNormals   boolean            mirror normals that turn away from the viewer; else black there     (default true)
///
///         <bsdf type="bumpmap">
///             <texture type="bitmap" name="height">
///                 <string name="filename" value="wrinkles.png"/>
///                 <boolean name="raw" value="true"/>
///             </texture>
///             <float name="scale" value="0.1"/>
///             <boolean name="useShadowing" value="true"/>
///             <bsdf type="diffuse"/>
///         </bsdf>
class BumpMap final : public BentNormal {
public:
    explicit BumpMap(const Params& params)
        : BentNormal(params),
          scale_(params.number("scale", 1.f)),
          height_(params.number_texture(params.only_texture("height"), 0.f, Range::any()))
    {}

private:
    Vec3f bent_normal(const SurfacePoint& at) const override
    {
        const Vec2f slope = height_->slope(at) * scale_;
        Vec3f along_u(1.f, 0.f, 0.f), along_v(0.f, 1.f, 0.f);
        if (at.shape) {
            const Tangents tangents = tangents_at(at);
            along_u = at.shading.to_local(tangents.dp_du);
            along_v = at.shading.to_local(tangents.dp_dv);
        }
        const Vec3f bent = cross(Vec3f(along_u.x, along_u.y, slope.x), Vec3f(along_v.x, along_v.y, slope.y));
        if (bent.z == 0.f || !(dot(bent, bent) < infinity)) return {0.f, 0.f, 1.f}; // no tangents to speak of
        return bent.z > 0.f ? bent : -bent;
    }

    float scale_;
    std::shared_ptr<const NumberTexture> height_;
};

template std::unique_ptr<Bsdf> build<BumpMap>(const Params&);

} // namespace plumb
