// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".

#include "bsdfs/refraction_indices.h"
#include "bsdfs/rough_reflection.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A rough boundary between two transparent media: frosted glass, from both sides.
///
/// Beckmann microfacets reflect by [Walter et al. 2007], equation 20, and refract by equation 21, in the form that
/// transports radiance: as with the smooth dielectric, refraction scales it by (eta_i / eta_t)^2. Both are
/// multiplied by ka. The interior is the side opposite to the normal. Where the indices differ by less than one part
/// in ten thousand there is no boundary, whatever its roughness: rays go straight through, multiplied by ka.
///
///     alpha    float or texture   roughness, in (0, 1]; less than 0.0001 counts as 0.0001   (default 0.1)
///     intIOR   float              index of refraction inside, in [0.01, 100]                (default 1.5046)
///     extIOR   float              index of refraction outside, in [0.01, 100]               (default 1.000277)
///     ka       color or texture   tint of reflected and refracted light, in [0, 1]          (default 1)
///
///         <bsdf type="roughdielectric">
///             <float name="alpha" value="0.2"/>
///             <color name="ka" value="0.9 1 0.9"/>
///         </bsdf>
class RoughDielectric final : public Bsdf {
public:
    explicit RoughDielectric(const Params& params)
        : alpha_(params.scalar_texture("alpha", 0.1f, Range::positive_to(1.0))),
          ka_(params.texture("ka", Color(1.f), Range::closed(0.0, 1.0))),
          eta_(RefractionIndices(params).eta()),
          matched_(std::abs(eta_ - 1.f) < 1e-4f)
    {}

    Lobes lobes() const override
    {
        return matched_ ? Lobes(Lobe::delta_transmission)
                        : Lobe::glossy_reflection | Lobe::glossy_transmission;
    }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (matched_ || wi.z == 0.f || wo.z == 0.f) return {};
        return evaluate(beckmann_at(*alpha_, at.uv), ka_->color(at.uv), wi, wo);
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (wi.z == 0.f) return std::nullopt;
        const Color ka = ka_->color(at.uv);
        if (matched_) return BsdfSample{-wi, ka, 1.f, Lobe::delta_transmission, 1.f};

        // A microfacet that wi sees, then the way that its own reflectance chooses.
        const Beckmann microfacets = beckmann_at(*alpha_, at.uv);
        const Vec3f wh = microfacets.sample_visible(upwards(wi), u);
        const float cos_i = dot(wi, wh);
        if (!same_side(cos_i, wi.z)) return std::nullopt;
        const Refraction fresnel = fresnel_dielectric(cos_i, eta_);
        const bool reflected = u_lobe < fresnel.reflectance;
        const std::optional<Vec3f> wo = reflected ? reflect(wi, wh) : refract(wi, wh, eta_);
        if (!wo || wo->z == 0.f || same_hemisphere(wi, *wo) != reflected) return std::nullopt;

        const auto [f_cos, pdf] = evaluate(microfacets, ka, wi, *wo);
        if (!(pdf > 0.f)) return std::nullopt;
        if (reflected) return BsdfSample{*wo, f_cos / pdf, pdf, Lobe::glossy_reflection, 1.f};
        return BsdfSample{*wo, f_cos / pdf, pdf, Lobe::glossy_transmission, 1.f / fresnel.eta_ratio};
    }

private:
    // Whether both cosines have the same sign; their product could underflow.
    static bool same_side(float a, float b) { return a > 0.f ? b > 0.f : a < 0.f && b < 0.f; }

    BsdfValue evaluate(const Beckmann& microfacets, const Color& ka, const Vec3f& wi, const Vec3f& wo) const
    {
        return same_hemisphere(wi, wo) ? reflection(microfacets, ka, wi, wo)
                                       : transmission(microfacets, ka, wi, wo);
    }

    BsdfValue reflection(const Beckmann& microfacets, const Color& ka, const Vec3f& wi, const Vec3f& wo) const
    {
        const auto [cos_h, dg_cos, wh_pdf] = rough_reflection(microfacets, wi, wo);
        const float reflectance = fresnel_dielectric(cos_h, eta_).reflectance;
        const float pdf = reflectance * wh_pdf;
        if (!(pdf > 0.f)) return {};
        return {ka * (reflectance * dg_cos), pdf};
    }

    BsdfValue transmission(const Beckmann& microfacets, const Color& ka, const Vec3f& wi,
                           const Vec3f& wo) const
    {
        // [1], equation 16, in double precision: wi and wo nearly cancel where the indices are close.
        const double ratio = wi.z > 0.f ? 1.0 / static_cast<double>(eta_) : static_cast<double>(eta_);
        const Vec3d sum = Vec3d(wi) * ratio + Vec3d(wo);
        const double length_squared_of_sum = length_squared(sum);
        if (!(length_squared_of_sum > 0.0)) return {};
        const Vec3d half = sum * ((sum.z < 0.0 ? -1.0 : 1.0) / std::sqrt(length_squared_of_sum));
        const Vec3f wh(half);

        // Both directions must see their own side of the microfacet.
        const float cos_i = static_cast<float>(dot(Vec3d(wi), half));
        const float cos_o = static_cast<float>(dot(Vec3d(wo), half));
        if (!same_side(cos_i, wi.z) || !same_side(cos_o, wo.z)) return {};

        // The reflectance is the same from both sides. Near the critical angle only the thinner side's cosine keeps
        // its digits.
        const bool wi_in_thinner = (wi.z > 0.f) == (eta_ > 1.f);
        const float transmittance = 1.f - fresnel_dielectric(wi_in_thinner ? cos_i : cos_o, eta_).reflectance;

        // [1], equations 17 and 21: the denominator (wi . wh eta_i + wo . wh eta_t)^2 / eta_t^2 is the squared length
        // of the sum above.
        const float d = microfacets.d(wh);
        const float jacobian =
            static_cast<float>(static_cast<double>(std::abs(cos_o)) / length_squared_of_sum);
        const float visible = std::abs(cos_i) / microfacets.visible_area(upwards(wi));
        const float pdf = transmittance * d * visible * jacobian;
        if (!(pdf > 0.f)) return {};
        const float g = microfacets.g(wi, wo, wh);
        const float scale = static_cast<float>(sqr(ratio));
        return {ka * (transmittance * d * jacobian * scale * (g * std::abs(cos_i) / std::abs(wi.z))), pdf};
    }

    std::shared_ptr<const Texture> alpha_;
    std::shared_ptr<const Texture> ka_;
    float eta_;    // interior / exterior
    bool matched_; // no boundary at all
};

template std::unique_ptr<Bsdf> build<RoughDielectric>(const Params&);

} // namespace plumb
