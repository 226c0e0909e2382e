// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// A surface that is not there: all light passes straight through it. For the shape of a light that is invisible itself, or
/// for the border of a space.
///
///         <bsdf type="null"/>
class NullBsdf final : public Bsdf {
public:
    explicit NullBsdf(const Params&) {}

    Lobes lobes() const override { return Lobe::null; }
    float opacity(const SurfacePoint&) const override { return 0.f; }
    BsdfValue evaluate(const SurfacePoint&, const Vec3f&, const Vec3f&) const override { return {}; }
    std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3f& wi, float, const Vec2f&) const override
    {
        return BsdfSample{-wi, Color(1.f), 1.f, Lobe::null};
    }
};

template std::unique_ptr<Bsdf> build<NullBsdf>(const Params&);

} // namespace plumb
