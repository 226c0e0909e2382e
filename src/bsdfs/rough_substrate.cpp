// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".
// [2] Ashikhmin and Shirley 2000, "An Anisotropic Phong BRDF Model".

#include "bsdfs/refraction_indices.h"
#include "bsdfs/rough_reflection.h"
#include "bsdfs/roughness.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"
#include "plumb/sampling/sampling.h"

namespace plumb {

/// A diffuse base under a rough dielectric coat that trades energy with it, on the front side.
///
/// f = 28 kd / (23 pi) (1 - r0) (1 - (1 - cos_i / 2)^5) (1 - (1 - cos_o / 2)^5) + D F G / (4 cos_i cos_o): the first
/// term after [Ashikhmin and Shirley 2000], equation 5, with r0 = ((ext - int) / (ext + int))^2; D and G after
/// [Walter et al. 2007], equations 25 and 27, F the exact dielectric reflectance at wh . wi. If the inside has the
/// lower index, the coat reflects totally beyond the critical angle while the base still shines: more light leaves than
/// arrives, and a warning says so.
///
///     alpha          float or texture   roughness, in [0, 1]; less than 0.0001 counts as 0.0001   (default 0.1)
///     distribution   string             of the microfacets: beckmann or ggx                       (default beckmann)
///     alphaU         float or texture   roughness along dp/du, in [0, 1]                          (default: alpha)
///     alphaV         float or texture   roughness along dp/dv, in [0, 1]                          (default: alpha)
///     intIOR         float              index of refraction inside, in [0.01, 100]                (default 1.5046)
///     extIOR         float              index of refraction outside, in [0.01, 100]               (default 1.000277)
///     kd             color or texture   albedo of the base, in [0, 1]                             (default 0.5)
///
///         <bsdf type="roughsubstrate">
///             <float name="alpha" value="0.05"/>
///             <texture type="checker" name="kd"/>
///         </bsdf>
class RoughSubstrate final : public Bsdf {
public:
    explicit RoughSubstrate(const Params& params) : RoughSubstrate(params, RefractionIndices(params)) {}

    bool is_oriented() const override { return roughness_.is_oriented(); }
    Lobes lobes() const override { return Lobe::diffuse_reflection | Lobe::glossy_reflection; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        return evaluate(material(at, wi), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const Material here = material(at, wi);
        const bool glossy = u_lobe < here.glossy_chance;
        const Vec3f wo =
            glossy ? reflect(wi, here.microfacets.sample_visible(wi, u)) : square_to_cosine_hemisphere(u);
        if (!(wo.z > 0.f)) return std::nullopt;
        const auto [f_cos, pdf] = evaluate(here, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, glossy ? Lobe::glossy_reflection : Lobe::diffuse_reflection,
                          1.f};
    }

private:
    struct Material {
        MicrofacetDistribution microfacets;
        Color kd;
        float glossy_chance;
    };

    RoughSubstrate(const Params& params, const RefractionIndices& indices)
        : roughness_(params),
          kd_(params.color_texture("kd", Color(0.5f), Range::closed(0.0, 1.0))),
          eta_(indices.eta()),
          base_scale_(
              28.f / (23.f * pi) *
              (1.f - sqr((indices.exterior - indices.interior) / (indices.exterior + indices.interior))))
    {
        if (eta_ < 1.f)
            params.warn("intIOR",
                        "intIOR is below extIOR: beyond the critical angle this model reflects more light "
                        "than it receives");
    }

    Material material(const SurfacePoint& at, const Vec3f& wi) const
    {
        const Color kd = kd_->color(at);
        return {roughness_.at(at), kd, glossy_chance(kd, wi)};
    }

    // The lobe is chosen by the reflectance at wi, kept away from 0 and 1 unless a lobe is black.
    float glossy_chance(const Color& kd, const Vec3f& wi) const
    {
        if (eta_ == 1.f) return 0.f;
        if (kd.is_black()) return 1.f;
        const float glossy = fresnel_dielectric(wi.z, eta_).reflectance;
        const float base = luminance(kd) * (1.f - glossy);
        return std::clamp(glossy / (glossy + base), 0.1f, 0.9f);
    }

    BsdfValue evaluate(const Material& here, const Vec3f& wi, const Vec3f& wo) const
    {
        const auto [cos_h, dg_cos, glossy_pdf] = rough_reflection(here.microfacets, wi, wo);
        const float pdf = lerp(cosine_hemisphere_pdf(wo), glossy_pdf, here.glossy_chance);
        if (!(pdf > 0.f)) return {};
        const float fresnel = fresnel_dielectric(cos_h, eta_).reflectance;
        const Color base = here.kd * (base_scale_ * transmitted(wi.z) * transmitted(wo.z) * wo.z);
        return {base + Color(fresnel * dg_cos), pdf};
    }

    // [2], equation 5: 1 - (1 - cos / 2)^5.
    static float transmitted(float cosine)
    {
        const float x = 1.f - 0.5f * cosine;
        return 1.f - sqr(sqr(x)) * x;
    }

    Roughness roughness_;
    std::shared_ptr<const ColorTexture> kd_;
    float eta_;
    float base_scale_;
};

template std::unique_ptr<Bsdf> build<RoughSubstrate>(const Params&);

} // namespace plumb
