// SPDX-License-Identifier: MIT

// [1] Lafortune and Willems 1994, "Using the Modified Phong Reflectance Model for Physically Based Rendering".

#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/math/frame.h"
#include "plumb/model/bsdf.h"
#include "plumb/model/texture.h"
#include "plumb/sampling/sampling.h"

namespace plumb {

/// The modified Phong model [Lafortune and Willems 1994] on the front side: a diffuse base and a cosine-power lobe.
///
/// f = kd / pi + ks (n + 2) / (2 pi) max(0, cos(a))^n, where a is the angle between wi and the mirrored wo; n = 0
/// everywhere is diffuse. If a channel of kd + ks can be above 1, both are multiplied by 0.99 / max(kd + ks).
///
///     diffuse-coefficients    color or texture   kd, at least 0          (default 0)
///     specular-coefficients   color or texture   ks, at least 0          (default 1)
///     exponent                float or texture   n, in [0, 100000000]    (default 1)
///
///         <bsdf type="phong">
///             <color name="diffuse-coefficients" value="0.2 0.2 0.2"/>
///             <color name="specular-coefficients" value="0.6 0.6 0.6"/>
///             <integer name="exponent" value="50"/>
///         </bsdf>
class Phong final : public Bsdf {
public:
    explicit Phong(const Params& params)
        : kd_(params.color_texture("diffuse-coefficients", Color(0.f))),
          ks_(params.color_texture("specular-coefficients", Color(1.f))),
          exponent_(params.number_texture("exponent", 1.f, Range::closed(0.0, 1e8))),
          is_diffuse_(exponent_->max_number() == 0.f)
    {
        const float largest = largest_sum();
        if (largest > 1.f) scale_ = 0.99f / largest;
        const float diffuse = luminance(kd_->mean() * scale_);
        const float glossy = is_diffuse_ ? 0.f : luminance(ks_->mean() * scale_);
        glossy_chance_ = glossy > 0.f ? glossy / (glossy + diffuse) : 0.f;
    }

    Lobes lobes() const override { return Lobe::diffuse_reflection | Lobe::glossy_reflection; }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        const float diffuse_pdf = cosine_hemisphere_pdf(wo);
        const Color kd = kd_->color(at) * scale_, ks = ks_->color(at) * scale_;
        if (is_diffuse_) return {(kd + ks) * diffuse_pdf, diffuse_pdf};
        const float exponent = exponent_->number(at);
        const float lobe = lobe_pdf(wi, wo, exponent);
        const float pdf = lerp(diffuse_pdf, lobe, glossy_chance_);
        if (!(pdf > 0.f)) return {};
        // [1], section 3: the lobe's factor is (n + 2) / (2 pi), that of its density (n + 1) / (2 pi).
        const float normalisation = (exponent + 2.f) / (exponent + 1.f);
        return {kd * diffuse_pdf + ks * (normalisation * lobe * wo.z), pdf};
    }

    // Either lobe is black where its chance is 0.
    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const bool glossy = u_lobe < glossy_chance_;
        const Vec3f wo = glossy
                             ? Frame(mirrored(wi)).to_world(square_to_cosine_power(u, exponent_->number(at)))
                             : square_to_cosine_hemisphere(u);
        const auto [f_cos, pdf] = evaluate(at, wi, wo);
        if (!(pdf > 0.f)) return std::nullopt;
        return BsdfSample{wo, f_cos / pdf, pdf, glossy ? Lobe::glossy_reflection : Lobe::diffuse_reflection,
                          1.f};
    }

private:
    // Of any channel of kd + ks; of textures that of both bounds.
    float largest_sum() const
    {
        if (dynamic_cast<const UniformTexture*>(kd_.get()) && dynamic_cast<const UniformTexture*>(ks_.get()))
            return max_component(kd_->mean() + ks_->mean());
        return kd_->max_value() + ks_->max_value();
    }

    static Vec3f mirrored(const Vec3f& w) { return {-w.x, -w.y, w.z}; }

    // (n + 1) / (2 pi) cos(a)^n, in double precision: rounding errors of the cosine grow n-fold.
    static float lobe_pdf(const Vec3f& wi, const Vec3f& wo, float exponent)
    {
        const Vec3d axis(mirrored(wi));
        const Vec3d w(wo);
        const double cosine = dot(axis, w) / std::sqrt(length_squared(axis) * length_squared(w));
        if (!(cosine > 0.0)) return 0.f;
        const double n = exponent;
        return static_cast<float>((n + 1.0) / (2.0 * pi_d) * exp(n * log(cosine)));
    }

    std::shared_ptr<const ColorTexture> kd_;
    std::shared_ptr<const ColorTexture> ks_;
    std::shared_ptr<const NumberTexture> exponent_;
    bool is_diffuse_;
    float scale_ = 1.f; // of kd and ks
    float glossy_chance_ = 0.f;
};

template std::unique_ptr<Bsdf> build<Phong>(const Params&);

} // namespace plumb
