// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/bsdf.h"

namespace plumb {

/// Gives a surface that is black from behind a back: the same as its front, or that of a second BSDF.
///
///         <bsdf type="twosided">
///             <bsdf type="diffuse"/>
///         </bsdf>
///
///         <bsdf type="twosided">
///             <bsdf type="diffuse"/>
///             <bsdf type="roughconductor">
///                 <float name="alpha" value="0.4"/>
///             </bsdf>
///         </bsdf>
class TwoSided final : public Bsdf {
public:
    explicit TwoSided(const Params& params)
        : front_(params.bsdf(0)),
          back_(params.bsdf_count() > 1 ? params.bsdf(1) : front_),
          lobes_(front_->lobes() | back_->lobes()),
          is_oriented_(front_->is_oriented() || back_->is_oriented()),
          is_reciprocal_(front_->is_reciprocal() && back_->is_reciprocal())
    {
        if (front_->lobes().has_any(passing)) refuse(params, 0);
        if (params.bsdf_count() > 1 && back_->lobes().has_any(passing)) refuse(params, 1);
    }

    Lobes lobes() const override { return lobes_; }
    bool is_oriented() const override { return is_oriented_; }
    bool has_back() const override { return true; }
    bool is_reciprocal() const override { return is_reciprocal_; }
    bool conserves_energy() const override { return front_->conserves_energy() && back_->conserves_energy(); }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        return wi.z > 0.f ? front_->evaluate(at, wi, wo) : back_->evaluate(at, turned(wi), turned(wo));
    }

    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (wi.z > 0.f) return front_->sample(at, wi, u_lobe, u);
        auto sampled = back_->sample(at, turned(wi), u_lobe, u);
        if (sampled) sampled->wo = turned(sampled->wo);
        return sampled;
    }

private:
    static constexpr Lobes passing = transmission_lobes | Lobe::null;

    static Vec3f turned(const Vec3f& w) { return {w.x, w.y, -w.z}; }

    static void refuse(const Params& params, std::size_t i)
    {
        params.fail_bsdf(
            i, params.bsdf(i)->lobes().has_any(Lobe::null)
                   ? "what lets light pass stands around 'twosided', not in it: <bsdf type=\"mask\"> "
                     "<bsdf type=\"twosided\"> ... </bsdf> </bsdf>"
                   : "a BSDF that transmits light has a back already; use it without 'twosided'");
    }

    std::shared_ptr<const Bsdf> front_;
    std::shared_ptr<const Bsdf> back_;
    Lobes lobes_;
    bool is_oriented_;
    bool is_reciprocal_;
};

template std::unique_ptr<Bsdf> build<TwoSided>(const Params&);

} // namespace plumb
