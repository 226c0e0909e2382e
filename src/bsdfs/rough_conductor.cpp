// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".
// [2] Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".

#include "bsdfs/conductor_fresnel.h"
#include "bsdfs/rough_reflection.h"
#include "bsdfs/roughness.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A rough metal: microfacets on the front side.
///
/// f = D(wh) F(wh . wi) G(wi, wo, wh) / (4 cos_i cos_o); D and G after [Walter et al. 2007], equations 25 and 27, or 33 and
/// 34 for ggx. F follows [Schlick 1994], equation 15, R0 + (1 - R0) (1 - wh . wi)^5, or, where material, eta, k or extIOR is
/// given, the exact equations of a conductor, as in the BSDF 'conductor'.
///
///     alpha                 float or texture   roughness, in [0, 1]; less than 0.0001 counts as 0.0001           (default 0.1)
///     distribution          string             of the microfacets: beckmann or ggx                               (default beckmann)
///     alphaU                float or texture   roughness along dp/du, in [0, 1]                                  (default: alpha)
///     alphaV                float or texture   roughness along dp/dv, in [0, 1]                                  (default: alpha)
///     R0                    color or texture   reflectance along the normal, in [0, 1]; not with the next four   (default 0.5)
///     material              string             a name, as of 'conductor'; not with eta or k                      (default none)
///     eta                   color or texture   real part of the index, at least 0                                (default: material's)
///     k                     color or texture   imaginary part (absorption), at least 0                           (default: material's)
///     extIOR                float              index of refraction outside, in [0.01, 100]                       (default 1)
///     specularReflectance   color or texture   multiplies the reflected light, in [0, 1]                         (default 1)
///
///         <bsdf type="roughconductor">
///             <float name="alpha" value="0.3"/>
///             <color name="R0" value="1 0.71 0.29"/>
///         </bsdf>
///
///         <bsdf type="roughconductor">
///             <string name="material" value="Cu"/>
///             <string name="distribution" value="ggx"/>
///             <float name="alphaU" value="0.3"/>
///             <float name="alphaV" value="0.6"/>
///         </bsdf>
class RoughConductor final : public Bsdf {
public:
    explicit RoughConductor(const Params& params)
        : roughness_(params),
          r0_(params.color_texture("R0", Color(0.5f), Range::closed(0.0, 1.0))),
          conductor_(params)
    {
        if (conductor_.is_asked_for() && params.has("R0"))
            params.fail("R0", "cannot be given together with material, eta, k or extIOR");
    }

    Lobes lobes() const override { return Lobe::glossy_reflection; }
    bool is_oriented() const override { return roughness_.is_oriented(); }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        return evaluate(at, roughness_.at(at), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float /*u_lobe*/,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const MicrofacetDistribution microfacets = roughness_.at(at);
        const Vec3f wo = reflect(wi, microfacets.sample_visible(wi, u));
        if (!(wo.z > 0.f)) return std::nullopt;
        const auto [f_cos, pdf] = evaluate(at, microfacets, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, Lobe::glossy_reflection, 1.f};
    }

private:
    BsdfValue evaluate(const SurfacePoint& at, const MicrofacetDistribution& microfacets, const Vec3f& wi,
                       const Vec3f& wo) const
    {
        const auto [cos_h, dg_cos, pdf] = rough_reflection(microfacets, wi, wo);
        if (!(pdf > 0.f)) return {};
        return {reflectance(at, cos_h) * dg_cos, pdf};
    }

    Color reflectance(const SurfacePoint& at, float cos_h) const
    {
        return conductor_.is_asked_for() ? conductor_.reflectance(at, cos_h)
                                         : fresnel_schlick(cos_h, r0_->color(at)) * conductor_.scale(at);
    }

    Roughness roughness_;
    std::shared_ptr<const ColorTexture> r0_;
    ConductorFresnel conductor_;
};

template std::unique_ptr<Bsdf> build<RoughConductor>(const Params&);

} // namespace plumb
