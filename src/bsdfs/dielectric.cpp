// SPDX-License-Identifier: MIT

// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation".

#include "bsdfs/fresnel.h"
#include "bsdfs/refraction_indices.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A smooth boundary between two transparent media: reflection and refraction after Fresnel's equations.
///
/// Works from both sides; the interior is the side opposite to the normal. Light is unpolarised. Refracted radiance
/// is scaled by (eta_i / eta_t)^2, [Veach 1997], equation 5.2, where eta_i is the index on the viewer's side; the
/// factors cancel on paths that start and end in the same medium. The default is borosilicate glass in air. With equal indices rays go straight through.
///
///     intIOR                  float              index of refraction inside, in [0.01, 100]    (default 1.5046)
///     extIOR                  float              index of refraction outside, in [0.01, 100]   (default 1.000277)
///     specularReflectance     color or texture   multiplies reflected light, in [0, 1]         (default 1)
///     specularTransmittance   color or texture   multiplies refracted light, in [0, 1]         (default 1)
///
///         <bsdf type="dielectric">
///             <float name="intIOR" value="1.33"/>
///         </bsdf>
class Dielectric final : public Bsdf {
public:
    explicit Dielectric(const Params& params)
        : eta_(RefractionIndices(params).eta()),
          reflected_(params.color_texture("specularReflectance", Color(1.f), Range::closed(0.0, 1.0))),
          refracted_(params.color_texture("specularTransmittance", Color(1.f), Range::closed(0.0, 1.0)))
    {}

    Lobes lobes() const override { return Lobe::delta_reflection | Lobe::delta_transmission; }

    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& /*u*/) const override
    {
        if (wi.z == 0.f) return std::nullopt;
        const auto [reflectance, cos_t, ratio] = fresnel_dielectric(wi.z, eta_);
        if (u_lobe < reflectance)
            return BsdfSample{Vec3f(-wi.x, -wi.y, wi.z), reflected_->color(at), reflectance,
                              Lobe::delta_reflection, 1.f};

        const Vec3f wo(-ratio * wi.x, -ratio * wi.y, cos_t);
        return BsdfSample{wo, refracted_->color(at) * sqr(ratio), 1.f - reflectance, Lobe::delta_transmission,
                          1.f / ratio};
    }

private:
    float eta_; // interior / exterior
    std::shared_ptr<const ColorTexture> reflected_;
    std::shared_ptr<const ColorTexture> refracted_;
};

template std::unique_ptr<Bsdf> build<Dielectric>(const Params&);

} // namespace plumb
