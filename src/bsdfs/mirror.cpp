// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A perfect mirror on the front side: every ray is reflected, with reflectance 1. Black from behind.
///
/// It has no parameters.
///
///         <bsdf type="mirror"/>
class Mirror final : public Bsdf {
public:
    explicit Mirror(const Params&) {}

    Lobes lobes() const override { return Lobe::delta_reflection; }

    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }

    std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3f& wi, float /*u_lobe*/,
                                     const Vec2f& /*u*/) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        return BsdfSample{Vec3f(-wi.x, -wi.y, wi.z), Color(1.f), 1.f, Lobe::delta_reflection, 1.f};
    }
};

template std::unique_ptr<Bsdf> build<Mirror>(const Params&);

} // namespace plumb
