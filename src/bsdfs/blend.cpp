// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// The mean of two BSDFs: (1 - weight) times the first and weight times the second, in the order of the file.
///
///     weight   float or texture   of the second one, in [0, 1]   (default 0.5)
///
///         <bsdf type="blend">
///             <float name="weight" value="0.3"/>
///             <bsdf type="diffuse"/>
///             <bsdf type="roughconductor">
///                 <float name="alpha" value="0.4"/>
///             </bsdf>
///         </bsdf>
///
///         <bsdf type="blend">
///             <texture type="checker" name="weight">
///                 <color name="color1" value="0.6 0.6 0.6"/>
///                 <color name="color2" value="0.9 0.9 0.9"/>
///             </texture>
///             <bsdf type="mirror"/>
///             <bsdf type="diffuse"/>
///         </bsdf>
class Blend final : public Bsdf {
public:
    explicit Blend(const Params& params)
        : weight_(params.number_texture("weight", 0.5f, Range::closed(0.0, 1.0))),
          first_(params.bsdf(0)),
          second_(params.bsdf(1))
    {}

    Lobes lobes() const override { return first_->lobes() | second_->lobes(); }
    bool is_oriented() const override { return first_->is_oriented() || second_->is_oriented(); }
    bool has_back() const override { return first_->has_back() || second_->has_back(); }
    bool is_reciprocal() const override { return first_->is_reciprocal() && second_->is_reciprocal(); }
    float opacity(const SurfacePoint& at) const override
    {
        return lerp(first_->opacity(at), second_->opacity(at), weight(at));
    }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        const float weight_of_second = weight(at), weight_of_first = 1.f - weight_of_second;
        const BsdfValue first = first_->evaluate(at, wi, wo);
        const BsdfValue second = second_->evaluate(at, wi, wo);
        return {first.f_cos * weight_of_first + second.f_cos * weight_of_second,
                first.pdf * weight_of_first + second.pdf * weight_of_second};
    }

    // Delta lobes belong to one of the two each; a direction that both could have chosen counts for both.
    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        const float weight_of_second = weight(at);
        const bool is_second = u_lobe < weight_of_second;
        const float probability = is_second ? weight_of_second : 1.f - weight_of_second;
        const float u_rest =
            is_second ? u_lobe / weight_of_second : (u_lobe - weight_of_second) / (1.f - weight_of_second);
        auto sampled = (is_second ? second_ : first_)->sample(at, wi, std::min(u_rest, one_minus_epsilon), u);
        if (!sampled) return sampled;
        if (sampled->is_delta()) {
            sampled->pdf *= probability;
            return sampled;
        }
        const BsdfValue value = evaluate(at, wi, sampled->wo);
        if (!(value.pdf > 0.f)) return std::nullopt;
        sampled->weight = value.f_cos / value.pdf;
        sampled->pdf = value.pdf;
        return sampled;
    }

private:
    float weight(const SurfacePoint& at) const { return weight_->number(at); }

    std::shared_ptr<const NumberTexture> weight_; // of the second
    std::shared_ptr<const Bsdf> first_;
    std::shared_ptr<const Bsdf> second_;
};

template std::unique_ptr<Bsdf> build<Blend>(const Params&);

} // namespace plumb
