// SPDX-License-Identifier: MIT

#include "bsdfs/fresnel.h"
#include "bsdfs/refraction_indices.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A thin pane of a transparent medium, such as window glass, as one surface: light is reflected or goes straight through.
///
/// With all reflections inside the pane, R' = R + T^2 R / (1 - R^2) = 2 R / (1 + R) for the reflectance R of one of its
/// faces after Fresnel's equations and T = 1 - R; 1 - R' goes through. Works from both sides. Light is unpolarised.
///
///     intIOR                  float              index of refraction of the pane, in [0.01, 100]   (default 1.5046)
///     extIOR                  float              index of refraction around it, in [0.01, 100]     (default 1.000277)
///     specularReflectance     color or texture   multiplies reflected light, in [0, 1]             (default 1)
///     specularTransmittance   color or texture   multiplies light that goes through, in [0, 1]     (default 1)
///
///         <bsdf type="thindielectric">
///             <float name="intIOR" value="1.5"/>
///         </bsdf>
class ThinDielectric final : public Bsdf {
public:
    explicit ThinDielectric(const Params& params)
        : eta_(RefractionIndices(params).eta()),
          reflected_(params.color_texture("specularReflectance", Color(1.f), Range::closed(0.0, 1.0))),
          transmitted_(params.color_texture("specularTransmittance", Color(1.f), Range::closed(0.0, 1.0)))
    {}

    Lobes lobes() const override { return Lobe::delta_reflection | Lobe::delta_transmission; }

    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& /*u*/) const override
    {
        if (wi.z == 0.f) return std::nullopt;
        const float one_face = fresnel_dielectric(std::abs(wi.z), eta_).reflectance;
        const float reflectance = 2.f * one_face / (1.f + one_face);
        if (u_lobe < reflectance)
            return BsdfSample{Vec3f(-wi.x, -wi.y, wi.z), reflected_->color(at), reflectance,
                              Lobe::delta_reflection, 1.f};
        return BsdfSample{-wi, transmitted_->color(at), 1.f - reflectance, Lobe::delta_transmission, 1.f};
    }

private:
    float eta_; // of the pane / around it
    std::shared_ptr<const ColorTexture> reflected_;
    std::shared_ptr<const ColorTexture> transmitted_;
};

template std::unique_ptr<Bsdf> build<ThinDielectric>(const Params&);

} // namespace plumb
