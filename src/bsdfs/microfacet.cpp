// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".

#include "bsdfs/refraction_indices.h"
#include "bsdfs/rough_reflection.h"
#include "bsdfs/roughness.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"
#include "plumb/sampling/sampling.h"

namespace plumb {

/// A glossy plastic: a diffuse base and dielectric Beckmann microfacets, on the front side.
///
/// f = kd / pi + ks D(wh) F(wh . wi) G(wi, wo, wh) / (4 cos_i cos_o) with ks = 1 - max(kd); D and G after [Walter et
/// al. 2007], equations 25 and 27, F the exact dielectric reflectance.
///
///     alpha          float or texture   roughness, in [0, 1]; less than 0.0001 counts as 0.0001   (default 0.1)
///     distribution   string             of the microfacets: beckmann or ggx                       (default beckmann)
///     alphaU         float or texture   roughness along dp/du, in [0, 1]                          (default: alpha)
///     alphaV         float or texture   roughness along dp/dv, in [0, 1]                          (default: alpha)
///     intIOR         float              index of refraction inside, in [0.01, 100]                (default 1.5046)
///     extIOR         float              index of refraction outside, in [0.01, 100]               (default 1.000277)
///     kd             color              albedo of the diffuse base, in [0, 1]                     (default 0.5)
///
///         <bsdf type="microfacet">
///             <float name="alpha" value="0.2"/>
///             <color name="kd" value="0.2 0.2 0.4"/>
///         </bsdf>
class Microfacet final : public Bsdf {
public:
    explicit Microfacet(const Params& params)
        : roughness_(params),
          eta_(RefractionIndices(params).eta()),
          kd_(params.color("kd", Color(0.5f), Range::closed(0.0, 1.0))),
          ks_(1.f - max_component(kd_))
    {}

    bool is_oriented() const override { return roughness_.is_oriented(); }
    Lobes lobes() const override { return Lobe::diffuse_reflection | Lobe::glossy_reflection; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        return evaluate(roughness_.at(at), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const MicrofacetDistribution microfacets = roughness_.at(at);
        const bool glossy = u_lobe < glossy_chance(wi);
        const Vec3f wo =
            glossy ? reflect(wi, microfacets.sample_visible(wi, u)) : square_to_cosine_hemisphere(u);
        if (!(wo.z > 0.f)) return std::nullopt;
        const auto [f_cos, pdf] = evaluate(microfacets, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, glossy ? Lobe::glossy_reflection : Lobe::diffuse_reflection,
                          1.f};
    }

private:
    BsdfValue evaluate(const MicrofacetDistribution& microfacets, const Vec3f& wi, const Vec3f& wo) const
    {
        const auto [cos_h, dg_cos, glossy_pdf] = rough_reflection(microfacets, wi, wo);
        const float fresnel = fresnel_dielectric(cos_h, eta_).reflectance;
        const float diffuse_pdf = cosine_hemisphere_pdf(wo);
        const float pdf = lerp(diffuse_pdf, glossy_pdf, glossy_chance(wi));
        if (!(pdf > 0.f)) return {};
        return {kd_ * diffuse_pdf + Color(ks_ * fresnel * dg_cos), pdf};
    }

    // The lobes are chosen by what they reflect at wi, but neither is starved. 0 or 1 where one is black.
    float glossy_chance(const Vec3f& wi) const
    {
        const float glossy = ks_ * fresnel_dielectric(wi.z, eta_).reflectance;
        if (glossy == 0.f) return 0.f;
        const float diffuse = luminance(kd_);
        return diffuse > 0.f ? std::clamp(glossy / (glossy + diffuse), 0.1f, 0.9f) : 1.f;
    }

    Roughness roughness_;
    float eta_;
    Color kd_;
    float ks_;
};

template std::unique_ptr<Bsdf> build<Microfacet>(const Params&);

} // namespace plumb
