// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// Makes holes in a surface: light passes straight through it with probability 1 - opacity, and meets the BSDF inside it
/// otherwise.
///
/// Light passes from both sides. Shadow rays are attenuated by 1 - opacity, so point lights shine through, too. A pass is no
/// bounce, unless countPasses of the integrator says so.
///
///     opacity   float or texture   in [0, 1]   (default 0.5)
///
///         <bsdf type="mask">
///             <float name="opacity" value="0.3"/>
///             <bsdf type="diffuse"/>
///         </bsdf>
///
///         <bsdf type="mask">
///             <texture type="checker" name="opacity">
///                 <color name="color1" value="0.8 0.8 0.8"/>
///                 <color name="color2" value="0 0 0"/>
///             </texture>
///             <bsdf type="roughconductor">
///                 <float name="alpha" value="0.4"/>
///             </bsdf>
///         </bsdf>
class Mask final : public Bsdf {
public:
    explicit Mask(const Params& params)
        : opacity_(params.number_texture("opacity", 0.5f, Range::closed(0.0, 1.0))), bsdf_(params.bsdf(0))
    {}

    Lobes lobes() const override { return bsdf_->lobes() | Lobe::null; }
    bool is_oriented() const override { return bsdf_->is_oriented(); }
    bool has_back() const override { return bsdf_->has_back(); }
    bool is_reciprocal() const override { return bsdf_->is_reciprocal(); }
    float opacity(const SurfacePoint& at) const override { return own_opacity(at) * bsdf_->opacity(at); }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        const float opacity = own_opacity(at);
        const BsdfValue value = bsdf_->evaluate(at, wi, wo);
        return {value.f_cos * opacity, value.pdf * opacity};
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        const float opacity = own_opacity(at);
        if (u_lobe >= opacity) return BsdfSample{-wi, Color(1.f), 1.f - opacity, Lobe::null};
        auto sampled = bsdf_->sample(at, wi, std::min(u_lobe / opacity, one_minus_epsilon), u);
        if (sampled) sampled->pdf *= opacity;
        return sampled;
    }

private:
    float own_opacity(const SurfacePoint& at) const { return opacity_->number(at); }

    std::shared_ptr<const NumberTexture> opacity_;
    std::shared_ptr<const Bsdf> bsdf_;
};

template std::unique_ptr<Bsdf> build<Mask>(const Params&);

} // namespace plumb
