// SPDX-License-Identifier: MIT

// [1] Burley 2012, "Physically Based Shading at Disney".
// [2] Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering".

#include "bsdfs/disney_terms.h"
#include "bsdfs/rough_refraction.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"
#include "plumb/model/texture.h"
#include "plumb/sampling/sampling.h"

namespace plumb {

/// Disney's BSDF ([Burley 2012], [Burley 2015]): plastics, metals, cloth, lacquer and glass from one set of parameters.
///
/// A diffuse body with retro-reflection and sheen, a GGX reflection with the exact dielectric Fresnel term mixed with
/// Schlick's of metals and of tinted highlights, GGX refraction times the square root of the base colour, and a clear coat
/// (GTR1, index 1.5). From behind only refracting surfaces are not black. It may reflect more light than it receives.
///
///     baseColor        color or texture   in [0, 1]                                                          (default 0.5)
///     roughness        float or texture   in [0, 1]; GGX's alpha is its square                               (default 0.5)
///     anisotropic      float or texture   in [0, 1]; the highlight is longer along dp/du                     (default 0)
///     metallic         float or texture   fraction that is a metal, in [0, 1]                                (default 0)
///     specTrans        float or texture   fraction of the rest that refracts, in [0, 1]                      (default 0)
///     eta              float              index inside over outside, in [0.01, 100]; not 1 (1.001 then)      (default: specular's)
///     specular         float              eta = 2 / (1 - sqrt(0.08 specular)) - 1, in [0, 12]; not with eta  (default 0.5)
///     specTint         float or texture   how much specular reflection has the base's hue, in [0, 1]         (default 0)
///     sheen            float or texture   reflection along the surface, as of cloth, in [0, 1]               (default 0)
///     sheenTint        float or texture   how much of it has the base's hue, in [0, 1]                       (default 0)
///     flatness         float or texture   how flat the diffuse part looks, in [0, 1]                         (default 0)
///     clearcoat        float or texture   strength of the coat, in [0, 1]                                    (default 0)
///     clearcoatGloss   float or texture   from a satin coat, 0, to a polished one, 1                         (default 0)
///
///         <bsdf type="principled">
///             <color name="baseColor" value="0.7 0.3 0.1"/>
///             <float name="roughness" value="0.6"/>
///             <float name="metallic" value="0.5"/>
///             <float name="clearcoat" value="0.4"/>
///         </bsdf>
///
///         <bsdf type="principled">
///             <color name="baseColor" value="0.7 0.9 0.8"/>
///             <float name="roughness" value="0.7"/>
///             <float name="specTrans" value="0.8"/>
///             <float name="eta" value="1.4"/>
///         </bsdf>
class Principled final : public Bsdf {
public:
    explicit Principled(const Params& params)
        : base_(params.color_texture("baseColor", Color(0.5f), Range::closed(0.0, 1.0))),
          roughness_(fraction(params, "roughness", 0.5f)),
          anisotropic_(fraction(params, "anisotropic", 0.f)),
          metallic_(fraction(params, "metallic", 0.f)),
          spec_trans_(fraction(params, "specTrans", 0.f)),
          eta_(eta_of(params)),
          spec_tint_(fraction(params, "specTint", 0.f)),
          sheen_(fraction(params, "sheen", 0.f)),
          sheen_tint_(fraction(params, "sheenTint", 0.f)),
          flatness_(fraction(params, "flatness", 0.f)),
          clearcoat_(fraction(params, "clearcoat", 0.f)),
          clearcoat_gloss_(fraction(params, "clearcoatGloss", 0.f)),
          refracts_(spec_trans_->max_number() > 0.f),
          is_diffuse_(metallic_->min_number() < 1.f &&
                      (spec_trans_->min_number() < 1.f || sheen_->max_number() > 0.f)),
          is_oriented_(anisotropic_->max_number() > 0.f)
    {}

    Lobes lobes() const override
    {
        Lobes lobes = Lobe::glossy_reflection;
        if (is_diffuse_) lobes = lobes | Lobe::diffuse_reflection;
        if (refracts_) lobes = lobes | Lobe::glossy_transmission;
        return lobes;
    }
    bool is_oriented() const override { return is_oriented_; }
    bool conserves_energy() const override { return false; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (wi.z == 0.f || wo.z == 0.f || (!refracts_ && !(wi.z > 0.f && wo.z > 0.f))) return {};
        return evaluate(surface(at), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f) && (!refracts_ || wi.z == 0.f)) return std::nullopt;
        const Surface here = surface(at);
        const Chances c = chances(here, wi);
        if (u_lobe >= c.specular) {
            const bool of_coat = u_lobe < c.specular + c.coat;
            const Vec3f wo = of_coat ? reflect(wi, sample_coat(here, u)) : square_to_cosine_hemisphere(u);
            if (!(wo.z > 0.f)) return std::nullopt;
            return sampled(here, wi, wo, of_coat ? Lobe::glossy_reflection : Lobe::diffuse_reflection, 1.f);
        }

        // A microfacet that wi sees, then the way that its own reflectance chooses.
        const Vec3f wh = here.microfacets.sample_visible(upwards(wi), u);
        const float cos_i = dot(wi, wh);
        if (!same_side(cos_i, wi.z)) return std::nullopt;
        const Refraction fresnel = fresnel_dielectric(cos_i, eta_);
        const bool refracted = u_lobe < c.specular * here.refracting(wi) * (1.f - fresnel.reflectance);
        const std::optional<Vec3f> wo = refracted ? refract(wi, wh, eta_) : reflect(wi, wh);
        if (!wo || wo->z == 0.f || same_hemisphere(wi, *wo) == refracted) return std::nullopt;
        if (refracted) return sampled(here, wi, *wo, Lobe::glossy_transmission, 1.f / fresnel.eta_ratio);
        return sampled(here, wi, *wo, Lobe::glossy_reflection, 1.f);
    }

private:
    // The values of the textures at a point.
    struct Surface {
        Color base;
        Color tint;
        float roughness, metallic, spec_trans, spec_tint, sheen, sheen_tint, flatness, clearcoat;
        float coat_alpha_squared;
        MicrofacetDistribution microfacets;

        float body() const { return (1.f - metallic) * (1.f - spec_trans); }
        float glass() const { return (1.f - metallic) * spec_trans; }
        // Of a microfacet's transmittance, what is refracted. From behind there is nothing but glass.
        float refracting(const Vec3f& wi) const { return wi.z > 0.f ? glass() : glass() > 0.f ? 1.f : 0.f; }
    };

    // Of the lobes, for a sample; together 1.
    struct Chances {
        float specular, coat, diffuse;
    };

    static std::shared_ptr<const NumberTexture> fraction(const Params& params, const char* name,
                                                         float fallback)
    {
        return params.number_texture(name, fallback, Range::closed(0.0, 1.0));
    }

    static float eta_of(const Params& params)
    {
        const float specular = params.number("specular", -1.f, Range::closed(0.0, 12.0));
        const float given = params.number("eta", 0.f, Range::closed(0.01, 100.0));
        if (given > 0.f && specular >= 0.f) params.fail("specular", "cannot be given together with eta");
        const float eta =
            given > 0.f ? given : 2.f / (1.f - std::sqrt(0.08f * (specular < 0.f ? 0.5f : specular))) - 1.f;
        return std::abs(eta - 1.f) < 1e-3f ? 1.001f : eta;
    }

    Surface surface(const SurfacePoint& at) const
    {
        const Color base = base_->color(at);
        const float roughness = roughness_->number(at);
        return {base,
                disney::tint_of(base),
                roughness,
                metallic_->number(at),
                spec_trans_->number(at),
                spec_tint_->number(at),
                sheen_->number(at),
                sheen_tint_->number(at),
                flatness_->number(at),
                clearcoat_->number(at),
                sqr(lerp(0.1f, 0.001f, clearcoat_gloss_->number(at))),
                disney::microfacets(roughness, anisotropic_->number(at))};
    }

    static Chances chances(const Surface& here, const Vec3f& wi)
    {
        if (wi.z < 0.f) return {1.f, 0.f, 0.f};
        const float coat = 0.25f * here.clearcoat;
        const float sum = 1.f + coat + here.body();
        return {1.f / sum, coat / sum, here.body() / sum};
    }

    std::optional<BsdfSample> sampled(const Surface& here, const Vec3f& wi, const Vec3f& wo, Lobe lobe,
                                      float eta) const
    {
        const auto [f_cos, pdf] = evaluate(here, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, lobe, eta};
    }

    BsdfValue evaluate(const Surface& here, const Vec3f& wi, const Vec3f& wo) const
    {
        if (same_hemisphere(wi, wo)) return wi.z > 0.f ? front(here, wi, wo) : back(here, wi, wo);
        const float refracting = here.refracting(wi);
        if (!(refracting > 0.f)) return {};
        const RoughRefraction lobe = rough_refraction(here.microfacets, eta_, wi, wo);
        const float pdf = chances(here, wi).specular * refracting * lobe.pdf;
        if (!(pdf > 0.f)) return {};
        const Color root(std::sqrt(here.base.r), std::sqrt(here.base.g), std::sqrt(here.base.b));
        return {root * (here.glass() * lobe.f_cos), pdf};
    }

    BsdfValue back(const Surface& here, const Vec3f& wi, const Vec3f& wo) const
    {
        if (!(here.glass() > 0.f)) return {};
        const auto [cos_h, dg_cos, pdf] = rough_reflection(here.microfacets, wi, wo);
        const float fresnel = fresnel_dielectric(cos_h, eta_).reflectance;
        if (!(fresnel * pdf > 0.f)) return {};
        return {Color(here.glass() * fresnel * dg_cos), fresnel * pdf};
    }

    BsdfValue front(const Surface& here, const Vec3f& wi, const Vec3f& wo) const
    {
        const auto [cos_h, dg_cos, glossy_pdf] = rough_reflection(here.microfacets, wi, wo);
        const float fresnel = fresnel_dielectric(cos_h, eta_).reflectance;
        const Chances c = chances(here, wi);
        const float diffuse_pdf = cosine_hemisphere_pdf(wo);
        float pdf =
            c.specular * (1.f - here.glass() * (1.f - fresnel)) * glossy_pdf + c.diffuse * diffuse_pdf;
        Color f_cos = specular_reflectance(here, fresnel, cos_h) * dg_cos;
        if (here.clearcoat > 0.f) {
            const BsdfValue coat = clear_coat(here, wi, wo, cos_h);
            pdf += c.coat * coat.pdf;
            f_cos += coat.f_cos;
        }
        if (here.body() > 0.f)
            f_cos +=
                here.base * (here.body() * inv_pi *
                             disney::diffuse(here.roughness, here.flatness, wi.z, wo.z, cos_h)) +
                disney::sheen(here.sheen, here.sheen_tint, here.tint, cos_h) * ((1.f - here.metallic) * wo.z);
        if (!(pdf > 0.f)) return {};
        return {f_cos, pdf};
    }

    // Of a dielectric exactly, of metals and tinted highlights after Schlick.
    Color specular_reflectance(const Surface& here, float fresnel, float cos_h) const
    {
        const float dielectric = 1.f - here.metallic;
        return Color(dielectric * (1.f - here.spec_tint) * fresnel) +
               schlick(here.base, cos_h) * here.metallic +
               schlick(here.tint * disney::reflectance_0(eta_), cos_h) * (dielectric * here.spec_tint);
    }

    // With the cosine on the thinner side.
    Color schlick(const Color& reflectance_0, float cos_h) const
    {
        return fresnel_schlick(eta_ > 1.f ? cos_h : std::abs(fresnel_dielectric(cos_h, eta_).cos_t),
                               reflectance_0);
    }

    // [1], section 5.6 and equation 4: GTR1, with the fixed F0 = 0.04 and the shadowing of alpha = 0.25, whose factor
    // 1 / (4 cos_i cos_o) is part of the strength 0.25.
    BsdfValue clear_coat(const Surface& here, const Vec3f& wi, const Vec3f& wo, float cos_h) const
    {
        const Vec3f wh(normalize(Vec3d(wi) + Vec3d(wo)));
        const float a2 = here.coat_alpha_squared;
        const float d = (a2 - 1.f) / (pi * log(a2) * (sqr(wh.x) + sqr(wh.y) + a2 * sqr(wh.z)));
        const float g = MicrofacetDistribution::ggx(0.25f).g(wi, wo, wh);
        const Color fresnel = schlick(Color(0.04f), cos_h);
        return {fresnel * (0.25f * here.clearcoat * d * g * wo.z),
                d * wh.z / (4.f * std::max(cos_h, 1e-12f))};
    }

    // [1], equation 5 (of the appendix).
    static Vec3f sample_coat(const Surface& here, const Vec2f& u)
    {
        const float a2 = here.coat_alpha_squared;
        const float sin_squared = std::max((pow(a2, 1.f - u.x) - a2) / (1.f - a2), 0.f);
        const SinCos phi = sin_cos(2.f * pi * u.y);
        const float sine = std::sqrt(sin_squared);
        return {sine * phi.cos, sine * phi.sin, safe_sqrt(1.f - sin_squared)};
    }

    std::shared_ptr<const ColorTexture> base_;
    std::shared_ptr<const NumberTexture> roughness_;
    std::shared_ptr<const NumberTexture> anisotropic_;
    std::shared_ptr<const NumberTexture> metallic_;
    std::shared_ptr<const NumberTexture> spec_trans_;
    float eta_; // interior / exterior
    std::shared_ptr<const NumberTexture> spec_tint_;
    std::shared_ptr<const NumberTexture> sheen_;
    std::shared_ptr<const NumberTexture> sheen_tint_;
    std::shared_ptr<const NumberTexture> flatness_;
    std::shared_ptr<const NumberTexture> clearcoat_;
    std::shared_ptr<const NumberTexture> clearcoat_gloss_;
    bool refracts_;
    bool is_diffuse_; // somewhere
    bool is_oriented_;
};

template std::unique_ptr<Bsdf> build<Principled>(const Params&);

} // namespace plumb
