// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// Bends the normal of the BSDF inside it, as a texture of normals says.
///
/// The colours of the texture are (n + 1) / 2 for a normal n: red along dp/du, blue along the normal of the surface, green
/// at right angles to both. Such pictures are linear, not sRGB. Blue below 0.5 points into the surface and counts as just
/// above 0.5.
///
/// Light is scattered only where it is on the same side of the bent normal as of the surface, so that none leaks
/// through. Where the bent normal turns away from the viewer, red and green are mirrored, so that nothing seen from the
/// front turns black.
///
///     normal   color or texture   in [0, 1]   (default 0.5 0.5 1: as the surface)
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
class NormalMap final : public Bsdf {
public:
    explicit NormalMap(const Params& params)
        : normal_(params.texture("normal", Color(0.5f, 0.5f, 1.f), Range::closed(0.0, 1.0))),
          bsdf_(params.bsdf(0)),
          lobes_(bsdf_->lobes()),
          has_back_(bsdf_->has_back())
    {}

    Lobes lobes() const override { return lobes_; }
    bool is_oriented() const override { return true; }
    bool has_back() const override { return has_back_; }
    float opacity(const SurfacePoint& at) const override { return bsdf_->opacity(at); }
    bool is_reciprocal() const override { return false; } // its cosine is that of the bent normal

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        const Frame bent = bent_frame(at, wi);
        const Vec3f bent_wi = bent.to_local(wi), bent_wo = bent.to_local(wo);
        if (!same_hemisphere(wi, bent_wi) || !same_hemisphere(wo, bent_wo)) return {};
        return bsdf_->evaluate(at, bent_wi, bent_wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        const Frame bent = bent_frame(at, wi);
        const Vec3f bent_wi = bent.to_local(wi);
        if (!same_hemisphere(wi, bent_wi)) return std::nullopt; // in the surface
        auto sampled = bsdf_->sample(at, bent_wi, u_lobe, u);
        if (!sampled) return sampled;
        const Vec3f wo = normalize(bent.to_world(sampled->wo));
        if (!same_hemisphere(wo, sampled->wo)) return std::nullopt;
        sampled->wo = wo;
        return sampled;
    }

private:
    // In the frame of the surface. wi is on the same side of its normal as of the surface's, unless it lies in it.
    Frame bent_frame(const SurfacePoint& at, const Vec3f& wi) const
    {
        constexpr float lowest = 1e-3f;
        const Color c = normal_->color(at.uv);
        Vec3f m = normalize(Vec3f(2.f * c.r - 1.f, 2.f * c.g - 1.f, std::max(2.f * c.b - 1.f, lowest)));
        if (!same_hemisphere(Vec3f(0.f, 0.f, dot(m, wi)), wi)) m = Vec3f(-m.x, -m.y, m.z);
        return Frame(m, Vec3f(1.f, 0.f, 0.f));
    }

    std::shared_ptr<const Texture> normal_;
    std::shared_ptr<const Bsdf> bsdf_;
    Lobes lobes_;
    bool has_back_;
};

template std::unique_ptr<Bsdf> build<NormalMap>(const Params&);

} // namespace plumb
