// SPDX-License-Identifier: MIT

// [1] Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering".

#include "bsdfs/disney_terms.h"
#include "bsdfs/rough_reflection.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"
#include "plumb/model/texture.h"
#include "plumb/sampling/sampling.h"

namespace plumb {

/// Disney's BSDF for thin sheets, such as leaves and paper, from both sides alike ([Burley 2015], section 5.3).
///
/// Light goes through without being refracted as a whole: the transmitted specular lobe is the reflected one on the other
/// side, with roughness times 0.65 eta - 0.35. It passes with 1 - F, F the exact dielectric reflectance, times the base colour.
/// Diffuse light is split between both sides. It may reflect more light than it receives.
///
///     baseColor     color or texture   in [0, 1]                                                      (default 0.5)
///     roughness     float or texture   in [0, 1]; GGX's alpha is its square                           (default 0.5)
///     anisotropic   float or texture   in [0, 1]; the highlight is longer along dp/du                 (default 0)
///     specTrans     float or texture   fraction that is clear instead of diffuse, in [0, 1]           (default 0)
///     eta           float              index of refraction over that outside, in [1.001, 2]           (default 1.5)
///     specTint      float or texture   how much specular reflection has the base's hue, in [0, 1]     (default 0)
///     sheen         float or texture   reflection along the surface, as of cloth, in [0, 1]           (default 0)
///     sheenTint     float or texture   how much of it has the base's hue, in [0, 1]                   (default 0)
///     flatness      float or texture   how flat the diffuse part looks, in [0, 1]                     (default 0)
///     diffTrans     float or texture   twice the part of diffuse light that goes through, in [0, 2]   (default 0)
///
///         <bsdf type="principledthin">
///             <color name="baseColor" value="0.3 0.6 0.2"/>
///             <float name="diffTrans" value="0.9"/>
///             <float name="specTrans" value="0.3"/>
///             <float name="sheen" value="0.2"/>
///         </bsdf>
class PrincipledThin final : public Bsdf {
public:
    explicit PrincipledThin(const Params& params)
        : base_(params.color_texture("baseColor", Color(0.5f), Range::closed(0.0, 1.0))),
          roughness_(fraction(params, "roughness", 0.5f)),
          anisotropic_(fraction(params, "anisotropic", 0.f)),
          spec_trans_(fraction(params, "specTrans", 0.f)),
          eta_(params.number("eta", 1.5f, Range::closed(1.001, 2.0))),
          spec_tint_(fraction(params, "specTint", 0.f)),
          sheen_(fraction(params, "sheen", 0.f)),
          sheen_tint_(fraction(params, "sheenTint", 0.f)),
          flatness_(fraction(params, "flatness", 0.f)),
          diff_trans_(params.number_texture("diffTrans", 0.f, Range::closed(0.0, 2.0))),
          is_oriented_(anisotropic_->max_number() > 0.f)
    {}

    Lobes lobes() const override
    {
        return Lobe::diffuse_reflection | Lobe::glossy_reflection | Lobe::glossy_transmission;
    }
    bool is_oriented() const override { return is_oriented_; }
    bool conserves_energy() const override { return false; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (wi.z == 0.f || wo.z == 0.f) return {};
        return evaluate(sheet(at, wi), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (wi.z == 0.f) return std::nullopt;
        const Sheet here = sheet(at, wi);
        const Chances& c = here.chances;
        const bool specular = u_lobe < c.spec_reflect + c.spec_through;
        const bool through =
            specular ? u_lobe >= c.spec_reflect : u_lobe >= c.spec_reflect + c.spec_through + c.diff_reflect;

        // On the front side, then to where it belongs.
        const Vec3f above(wi.x, wi.y, std::abs(wi.z));
        const MicrofacetDistribution& facets = through ? here.through : here.reflecting;
        Vec3f wo =
            specular ? reflect(above, facets.sample_visible(above, u)) : square_to_cosine_hemisphere(u);
        if (!(wo.z > 0.f)) return std::nullopt;
        if (through == (wi.z > 0.f)) wo.z = -wo.z;
        const auto [f_cos, pdf] = evaluate(here, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        const Lobe lobe = through    ? Lobe::glossy_transmission
                          : specular ? Lobe::glossy_reflection
                                     : Lobe::diffuse_reflection;
        return BsdfSample{wo, f_cos / pdf, pdf, lobe, 1.f};
    }

private:
    // Of the lobes, for a sample; together 1.
    struct Chances {
        float spec_reflect, spec_through, diff_reflect, diff_through;
    };

    // The values of the textures at a point.
    struct Sheet {
        Color base;
        float roughness, spec_trans, spec_tint, sheen, sheen_tint, flatness, diff_trans;
        MicrofacetDistribution reflecting, through;
        Chances chances;
    };

    static std::shared_ptr<const NumberTexture> fraction(const Params& params, const char* name,
                                                         float fallback)
    {
        return params.number_texture(name, fallback, Range::closed(0.0, 1.0));
    }

    Sheet sheet(const SurfacePoint& at, const Vec3f& wi) const
    {
        const float roughness = roughness_->number(at), anisotropic = anisotropic_->number(at);
        const float spec_trans = spec_trans_->number(at), diff_trans = diff_trans_->number(at);
        const float reflected = fresnel_dielectric(std::abs(wi.z), eta_).reflectance;
        const float spec_reflect = spec_trans * std::clamp(reflected, 0.1f, 0.9f);
        const float diff_through = (1.f - spec_trans) * 0.5f * diff_trans;
        return {base_->color(at),
                roughness,
                spec_trans,
                spec_tint_->number(at),
                sheen_->number(at),
                sheen_tint_->number(at),
                flatness_->number(at),
                diff_trans,
                disney::microfacets(roughness, anisotropic),
                disney::microfacets((0.65f * eta_ - 0.35f) * roughness, anisotropic), // [1], section 5.3
                {spec_reflect, spec_trans - spec_reflect, 1.f - spec_trans - diff_through, diff_through}};
    }

    BsdfValue evaluate(const Sheet& here, const Vec3f& wi, const Vec3f& wo) const
    {
        const bool through = !same_hemisphere(wi, wo);
        const Vec3f above_i(wi.x, wi.y, std::abs(wi.z)), above_o(wo.x, wo.y, std::abs(wo.z));
        const auto [cos_h, dg_cos, glossy_pdf] =
            rough_reflection(through ? here.through : here.reflecting, above_i, above_o);
        const float diffuse_pdf = cosine_hemisphere_pdf(above_o);
        const Chances& c = here.chances;
        const float pdf = through ? c.spec_through * glossy_pdf + c.diff_through * diffuse_pdf
                                  : c.spec_reflect * glossy_pdf + c.diff_reflect * diffuse_pdf;
        if (!(pdf > 0.f)) return {};

        const float fresnel = fresnel_dielectric(cos_h, eta_).reflectance;
        const float diffuse = 1.f - here.spec_trans;
        if (through)
            return {here.base * (here.spec_trans * (1.f - fresnel) * dg_cos +
                                 diffuse * 0.5f * here.diff_trans * diffuse_pdf),
                    pdf};

        const Color tint = disney::tint_of(here.base);
        const Color tinted = fresnel_schlick(cos_h, tint * disney::reflectance_0(eta_));
        const Color shine = disney::mix(Color(fresnel), tinted, here.spec_tint) * (here.spec_trans * dg_cos);
        const Color body =
            here.base *
                (disney::diffuse(here.roughness, here.flatness, above_i.z, above_o.z, cos_h) * inv_pi) +
            disney::sheen(here.sheen, here.sheen_tint, tint, cos_h) * above_o.z;
        return {shine + body * (diffuse * (1.f - 0.5f * here.diff_trans)), pdf};
    }

    std::shared_ptr<const ColorTexture> base_;
    std::shared_ptr<const NumberTexture> roughness_;
    std::shared_ptr<const NumberTexture> anisotropic_;
    std::shared_ptr<const NumberTexture> spec_trans_;
    float eta_;
    std::shared_ptr<const NumberTexture> spec_tint_;
    std::shared_ptr<const NumberTexture> sheen_;
    std::shared_ptr<const NumberTexture> sheen_tint_;
    std::shared_ptr<const NumberTexture> flatness_;
    std::shared_ptr<const NumberTexture> diff_trans_;
    bool is_oriented_;
};

template std::unique_ptr<Bsdf> build<PrincipledThin>(const Params&);

} // namespace plumb
