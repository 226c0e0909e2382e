// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".
// [2] Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".

#include "bsdfs/rough_reflection.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A rough metal: Beckmann microfacets with Schlick's Fresnel approximation, on the front side.
///
/// f = D(wh) F(wh . wi) G(wi, wo, wh) / (4 cos_i cos_o); D and G after [Walter et al. 2007], equations 25 and 27,
/// F = R0 + (1 - R0) (1 - wh . wi)^5 after [Schlick 1994], equation 15.
///
///     alpha   float or texture   roughness, in (0, 1]; less than 0.0001 counts as 0.0001   (default 0.1)
///     R0      color or texture   reflectance along the normal, in [0, 1]                   (default 0.5)
///
///         <bsdf type="roughconductor">
///             <float name="alpha" value="0.3"/>
///             <color name="R0" value="1 0.71 0.29"/>
///         </bsdf>
class RoughConductor final : public Bsdf {
public:
    explicit RoughConductor(const Params& params)
        : alpha_(params.scalar_texture("alpha", 0.1f, Range::positive_to(1.0))),
          r0_(params.texture("R0", Color(0.5f), Range::closed(0.0, 1.0)))
    {}

    Lobes lobes() const override { return Lobe::glossy_reflection; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        return evaluate(beckmann_at(*alpha_, at.uv), r0_->color(at.uv), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float /*u_lobe*/,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const Beckmann microfacets = beckmann_at(*alpha_, at.uv);
        const Vec3f wo = reflect(wi, microfacets.sample_visible(wi, u));
        if (!(wo.z > 0.f)) return std::nullopt;
        const auto [f_cos, pdf] = evaluate(microfacets, r0_->color(at.uv), wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, Lobe::glossy_reflection, 1.f};
    }

private:
    static BsdfValue evaluate(const Beckmann& microfacets, const Color& r0, const Vec3f& wi, const Vec3f& wo)
    {
        const auto [cos_h, dg_cos, pdf] = rough_reflection(microfacets, wi, wo);
        if (!(pdf > 0.f)) return {};
        return {fresnel_schlick(cos_h, r0) * dg_cos, pdf};
    }

    std::shared_ptr<const Texture> alpha_;
    std::shared_ptr<const Texture> r0_;
};

template std::unique_ptr<Bsdf> build<RoughConductor>(const Params&);

} // namespace plumb
