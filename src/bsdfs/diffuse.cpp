// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"
#include "plumb/sampling/sampling.h"

namespace plumb {

/// Ideally diffuse reflection on the front side: f = albedo / pi (Lambert 1760). Black from behind.
///
///     albedo   color or texture   fraction of light reflected, in [0, 1]   (default 0.5)
///
///         <bsdf type="diffuse">
///             <color name="albedo" value="0.7 0.2 0.1"/>
///         </bsdf>
class Diffuse final : public Bsdf {
public:
    explicit Diffuse(const Params& params)
        : albedo_(params.color_texture("albedo", Color(0.5f), Range::closed(0.0, 1.0)))
    {}

    Lobes lobes() const override { return Lobe::diffuse_reflection; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        const float pdf = cosine_hemisphere_pdf(wo);
        return {albedo_->color(at) * pdf, pdf};
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float /*u_lobe*/,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const Vec3f wo = square_to_cosine_hemisphere(u);
        if (!(wo.z > 0.f)) return std::nullopt;
        return BsdfSample{wo, albedo_->color(at), cosine_hemisphere_pdf(wo), Lobe::diffuse_reflection, 1.f};
    }

    Color albedo(const SurfacePoint& at, const Vec3f& wi) const override
    {
        return wi.z > 0.f ? albedo_->color(at) : Color(0.f);
    }

private:
    std::shared_ptr<const ColorTexture> albedo_;
};

template std::unique_ptr<Bsdf> build<Diffuse>(const Params&);

} // namespace plumb
