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
/// factors cancel on paths that start and end in the same medium. With equal indices rays go straight through.
///
///     intIOR   float   index of refraction inside, in [0.01, 100]    (default 1.5046, borosilicate glass)
///     extIOR   float   index of refraction outside, in [0.01, 100]   (default 1.000277, air)
///
///         <bsdf type="dielectric">
///             <float name="intIOR" value="1.33"/>
///         </bsdf>
class Dielectric final : public Bsdf {
public:
    explicit Dielectric(const Params& params) : eta_(RefractionIndices(params).eta()) {}

    Lobes lobes() const override { return Lobe::delta_reflection | Lobe::delta_transmission; }

    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3f& wi, float u_lobe,
                                     const Vec2f& /*u*/) const override
    {
        if (wi.z == 0.f) return std::nullopt;
        const auto [reflectance, cos_t, ratio] = fresnel_dielectric(wi.z, eta_);
        if (u_lobe < reflectance)
            return BsdfSample{Vec3f(-wi.x, -wi.y, wi.z), Color(1.f), reflectance, Lobe::delta_reflection,
                              1.f};

        const Vec3f wo(-ratio * wi.x, -ratio * wi.y, cos_t);
        return BsdfSample{wo, Color(sqr(ratio)), 1.f - reflectance, Lobe::delta_transmission, 1.f / ratio};
    }

private:
    float eta_; // interior / exterior
};

template std::unique_ptr<Bsdf> build<Dielectric>(const Params&);

} // namespace plumb
