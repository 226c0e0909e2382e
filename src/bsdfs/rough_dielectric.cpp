// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".

#include "bsdfs/refraction_indices.h"
#include "bsdfs/rough_reflection.h"
#include "bsdfs/rough_refraction.h"
#include "bsdfs/roughness.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A rough boundary between two transparent media: frosted glass, from both sides.
///
/// Microfacets reflect by [Walter et al. 2007], equation 20, and refract by equation 21, in the form that
/// transports radiance: as with the smooth dielectric, refraction scales it by (eta_i / eta_t)^2. Both are
/// multiplied by ka. D and G follow equations 25 and 27, or 33 and 34 for ggx. The interior is the side opposite to the normal. Where the indices differ by less than one part
/// in ten thousand there is no boundary, whatever its roughness: rays go straight through, multiplied by ka.
///
///     alpha                   float or texture   roughness, in [0, 1]; less than 0.0001 counts as 0.0001   (default 0.1)
///     distribution            string             of the microfacets: beckmann or ggx                       (default beckmann)
///     alphaU                  float or texture   roughness along dp/du, in [0, 1]                          (default: alpha)
///     alphaV                  float or texture   roughness along dp/dv, in [0, 1]                          (default: alpha)
///     intIOR                  float              index of refraction inside, in [0.01, 100]                (default 1.5046)
///     extIOR                  float              index of refraction outside, in [0.01, 100]               (default 1.000277)
///     ka                      color or texture   tint of reflected and refracted light, in [0, 1]          (default 1)
///     specularReflectance     color or texture   multiplies reflected light, in [0, 1]                     (default 1)
///     specularTransmittance   color or texture   multiplies refracted light, in [0, 1]                     (default 1)
///
///         <bsdf type="roughdielectric">
///             <float name="alpha" value="0.2"/>
///             <color name="ka" value="0.9 1 0.9"/>
///         </bsdf>
///
///         <bsdf type="roughdielectric">
///             <string name="distribution" value="ggx"/>
///             <float name="alphaU" value="0.4"/>
///             <float name="alphaV" value="0.6"/>
///             <color name="specularTransmittance" value="0.9 1 0.9"/>
///         </bsdf>
class RoughDielectric final : public Bsdf {
public:
    explicit RoughDielectric(const Params& params)
        : roughness_(params),
          ka_(params.color_texture("ka", Color(1.f), Range::closed(0.0, 1.0))),
          reflected_(params.color_texture("specularReflectance", Color(1.f), Range::closed(0.0, 1.0))),
          refracted_(params.color_texture("specularTransmittance", Color(1.f), Range::closed(0.0, 1.0))),
          eta_(RefractionIndices(params).eta()),
          matched_(std::abs(eta_ - 1.f) < 1e-4f)
    {}

    bool is_oriented() const override { return roughness_.is_oriented(); }
    Lobes lobes() const override
    {
        return matched_ ? Lobes(Lobe::delta_transmission)
                        : Lobe::glossy_reflection | Lobe::glossy_transmission;
    }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (matched_ || wi.z == 0.f || wo.z == 0.f) return {};
        return evaluate(at, roughness_.at(at), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (wi.z == 0.f) return std::nullopt;
        if (matched_)
            return BsdfSample{-wi, ka_->color(at) * refracted_->color(at), 1.f, Lobe::delta_transmission,
                              1.f};

        // A microfacet that wi sees, then the way that its own reflectance chooses.
        const MicrofacetDistribution microfacets = roughness_.at(at);
        const Vec3f wh = microfacets.sample_visible(upwards(wi), u);
        const float cos_i = dot(wi, wh);
        if (!same_side(cos_i, wi.z)) return std::nullopt;
        const Refraction fresnel = fresnel_dielectric(cos_i, eta_);
        const bool reflected = u_lobe < fresnel.reflectance;
        const std::optional<Vec3f> wo = reflected ? reflect(wi, wh) : refract(wi, wh, eta_);
        if (!wo || wo->z == 0.f || same_hemisphere(wi, *wo) != reflected) return std::nullopt;

        const auto [f_cos, pdf] = evaluate(at, microfacets, wi, *wo);
        if (!(pdf > 0.f)) return std::nullopt;
        if (reflected) return BsdfSample{*wo, f_cos / pdf, pdf, Lobe::glossy_reflection, 1.f};
        return BsdfSample{*wo, f_cos / pdf, pdf, Lobe::glossy_transmission, 1.f / fresnel.eta_ratio};
    }

private:
    BsdfValue evaluate(const SurfacePoint& at, const MicrofacetDistribution& microfacets, const Vec3f& wi,
                       const Vec3f& wo) const
    {
        const Color ka = ka_->color(at);
        return same_hemisphere(wi, wo) ? reflection(microfacets, ka * reflected_->color(at), wi, wo)
                                       : transmission(microfacets, ka * refracted_->color(at), wi, wo);
    }

    BsdfValue reflection(const MicrofacetDistribution& microfacets, const Color& tint, const Vec3f& wi,
                         const Vec3f& wo) const
    {
        const auto [cos_h, dg_cos, wh_pdf] = rough_reflection(microfacets, wi, wo);
        const float reflectance = fresnel_dielectric(cos_h, eta_).reflectance;
        const float pdf = reflectance * wh_pdf;
        if (!(pdf > 0.f)) return {};
        return {tint * (reflectance * dg_cos), pdf};
    }

    BsdfValue transmission(const MicrofacetDistribution& microfacets, const Color& tint, const Vec3f& wi,
                           const Vec3f& wo) const
    {
        const RoughRefraction lobe = rough_refraction(microfacets, eta_, wi, wo);
        if (!(lobe.pdf > 0.f)) return {};
        return {tint * lobe.f_cos, lobe.pdf};
    }

    Roughness roughness_;
    std::shared_ptr<const ColorTexture> ka_;
    std::shared_ptr<const ColorTexture> reflected_;
    std::shared_ptr<const ColorTexture> refracted_;
    float eta_;    // interior / exterior
    bool matched_; // no boundary at all
};

template std::unique_ptr<Bsdf> build<RoughDielectric>(const Params&);

} // namespace plumb
