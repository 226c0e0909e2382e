// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".

#include "bsdfs/plastic_base.h"
#include "bsdfs/rough_reflection.h"
#include "bsdfs/rough_transmittance.h"
#include "bsdfs/roughness.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A rough plastic: a rough dielectric coat over a diffuse base, on the front side.
///
/// f = D F G / (4 cos_i cos_o) + rho / (1 - q R_in) T(cos_i) T(cos_o) / (pi eta^2): the coat after [Walter et al. 2007],
/// equation 20, with equations 25 and 27, or 33 and 34 for ggx, and the exact dielectric F. T is what the coat refracts from
/// outside, R_in the mean of what it reflects from inside, both with the shadowing of the microfacets, so that less light
/// leaves a rough plastic than a smooth one. They are integrated when the scene is loaded, for 64 directions with equally
/// spaced cosines, which Mitsuba 3 also does. q is rho if `nonlinear`, else 1, as in 'plastic'.
///
///     alpha                 float              roughness, in [0, 1]; less than 0.0001 counts as 0.0001   (default 0.1)
///     distribution          string             of the microfacets: beckmann or ggx                       (default beckmann)
///     intIOR                float              index of refraction of the coat, in [0.01, 100]           (default 1.49)
///     extIOR                float              index of refraction outside, in [0.01, 100]               (default 1.000277)
///     diffuseReflectance    color or texture   rho, the albedo of the base, in [0, 1]                    (default 0.5)
///     specularReflectance   color or texture   multiplies what the coat reflects, in [0, 1]              (default 1)
///     nonlinear             boolean            whether each meeting with the base colours the light      (default false)
///
///         <bsdf type="roughplastic">
///             <float name="alpha" value="0.3"/>
///             <string name="distribution" value="ggx"/>
///             <color name="diffuseReflectance" value="0.1 0.27 0.36"/>
///         </bsdf>
///
///         <bsdf type="roughplastic">
///             <float name="alpha" value="0.4"/>
///             <color name="diffuseReflectance" value="0.9 0.5 1"/>
///             <boolean name="nonlinear" value="true"/>
///         </bsdf>
class RoughPlastic final : public Bsdf {
public:
    explicit RoughPlastic(const Params& params)
        : microfacets_(uniform_microfacets(params)),
          base_(params),
          outside_(microfacets_, base_.eta()),
          inside_(mean_inside_reflectance(microfacets_, base_.eta()))
    {}

    Lobes lobes() const override { return Lobe::diffuse_reflection | Lobe::glossy_reflection; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        const auto [cos_h, dg_cos, coat_pdf] = rough_reflection(microfacets_, wi, wo);
        const float enter = outside_.at(wi.z);
        const float pdf = lerp(cosine_hemisphere_pdf(wo), coat_pdf, base_.coat_chance(at, 1.f - enter));
        if (!(pdf > 0.f)) return {};
        const float fresnel = fresnel_dielectric(cos_h, base_.eta()).reflectance;
        return {base_.f_cos(at, enter, outside_.at(wo.z), inside_, wo.z) +
                    base_.specular(at) * (fresnel * dg_cos),
                pdf};
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const bool of_coat = u_lobe < base_.coat_chance(at, 1.f - outside_.at(wi.z));
        const Vec3f wo =
            of_coat ? reflect(wi, microfacets_.sample_visible(wi, u)) : square_to_cosine_hemisphere(u);
        const auto [f_cos, pdf] = evaluate(at, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, of_coat ? Lobe::glossy_reflection : Lobe::diffuse_reflection,
                          1.f};
    }

private:
    MicrofacetDistribution microfacets_;
    PlasticBase base_;
    RoughTransmittance outside_;
    float inside_; // the mean fraction of light from the base that the coat reflects back
};

template std::unique_ptr<Bsdf> build<RoughPlastic>(const Params&);

} // namespace plumb
