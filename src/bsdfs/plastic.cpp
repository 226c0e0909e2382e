// SPDX-License-Identifier: MIT

#include "bsdfs/fresnel.h"
#include "bsdfs/plastic_base.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A smooth plastic: a dielectric coat over a diffuse base, on the front side.
///
/// The coat reflects the fraction F(cos_i) like a mirror, after Fresnel's equations. The base adds
/// f = rho / (1 - q F_in) (1 - F(cos_i)) (1 - F(cos_o)) / (pi eta^2): light that the coat reflects back down, of which
/// F_in = 1 - mean(1 - F) / eta^2 is the mean fraction, meets the base again and again. q is rho if `nonlinear`, so that
/// colours become more saturated, else 1.
///
///     intIOR                float              index of refraction of the coat, in [0.01, 100]        (default 1.49)
///     extIOR                float              index of refraction outside, in [0.01, 100]            (default 1.000277)
///     diffuseReflectance    color or texture   rho, the albedo of the base, in [0, 1]                 (default 0.5)
///     specularReflectance   color or texture   multiplies what the coat reflects, in [0, 1]           (default 1)
///     nonlinear             boolean            whether each meeting with the base colours the light   (default false)
///
///         <bsdf type="plastic">
///             <color name="diffuseReflectance" value="0.1 0.27 0.36"/>
///             <float name="intIOR" value="1.9"/>
///         </bsdf>
///
///         <bsdf type="plastic">
///             <color name="diffuseReflectance" value="0.9 0.5 1"/>
///             <color name="specularReflectance" value="0.5 0.6 0.7"/>
///             <boolean name="nonlinear" value="true"/>
///         </bsdf>
class Plastic final : public Bsdf {
public:
    explicit Plastic(const Params& params)
        : base_(params), inside_(1.f - mean_transmittance(base_.eta()) / sqr(base_.eta()))
    {}

    Lobes lobes() const override { return Lobe::diffuse_reflection | Lobe::delta_reflection; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        const float reflected = coat(wi.z);
        const float pdf = (1.f - base_.coat_chance(at, reflected)) * cosine_hemisphere_pdf(wo);
        if (!(pdf > 0.f)) return {};
        return {base_.f_cos(at, 1.f - reflected, 1.f - coat(wo.z), inside_, wo.z), pdf};
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const float reflected = coat(wi.z);
        const float coat_chance = base_.coat_chance(at, reflected);
        if (u_lobe < coat_chance)
            return BsdfSample{Vec3f(-wi.x, -wi.y, wi.z), base_.specular(at) * (reflected / coat_chance),
                              coat_chance, Lobe::delta_reflection, 1.f};
        const Vec3f wo = square_to_cosine_hemisphere(u);
        const auto [f_cos, pdf] = evaluate(at, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, Lobe::diffuse_reflection, 1.f};
    }

private:
    float coat(float cosine) const { return fresnel_dielectric(cosine, base_.eta()).reflectance; }

    PlasticBase base_;
    float inside_; // the mean fraction of light from the base that the coat reflects back
};

template std::unique_ptr<Bsdf> build<Plastic>(const Params&);

} // namespace plumb
