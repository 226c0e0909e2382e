// SPDX-License-Identifier: MIT

#include "bsdfs/conductor_fresnel.h"
#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A smooth metal: a mirror on the front side that reflects after Fresnel's equations. Black from behind.
///
/// The index of refraction is eta + i k, for each of the three channels. Light is unpolarised. Names of materials are Ag, Al,
/// Au, Cr, Cu, Hg, Ir, Li, Mo, Na_palik, Ni_palik, Rh, Se, SiC, W, a-C and others; an unknown name lists them. "none"
/// reflects everything. Their RGB values are those of Mitsuba 3.9.1, which made them from measured spectra.
///
///     material              string             a name, as above; not with eta or k           (default none)
///     eta                   color or texture   real part of the index, at least 0            (default: material's)
///     k                     color or texture   imaginary part (absorption), at least 0       (default: material's)
///     extIOR                float              index of refraction outside, in [0.01, 100]   (default 1)
///     specularReflectance   color or texture   multiplies the reflected light, in [0, 1]     (default 1)
///
///         <bsdf type="conductor">
///             <string name="material" value="Au"/>
///         </bsdf>
///
///         <bsdf type="conductor">
///             <color name="eta" value="0.2 0.92 1.1"/>
///             <color name="k" value="3.9 2.45 2.14"/>
///             <color name="specularReflectance" value="0.9 0.9 0.8"/>
///         </bsdf>
class Conductor final : public Bsdf {
public:
    explicit Conductor(const Params& params) : fresnel_(params) {}

    Lobes lobes() const override { return Lobe::delta_reflection; }

    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float /*u_lobe*/,
                                     const Vec2f& /*u*/) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        return BsdfSample{Vec3f(-wi.x, -wi.y, wi.z), fresnel_.reflectance(at, wi.z), 1.f,
                          Lobe::delta_reflection, 1.f};
    }

    Color albedo(const SurfacePoint& at, const Vec3f& wi) const override
    {
        return wi.z > 0.f ? fresnel_.reflectance(at, wi.z) : Color(0.f);
    }

private:
    ConductorFresnel fresnel_;
};

template std::unique_ptr<Bsdf> build<Conductor>(const Params&);

} // namespace plumb
