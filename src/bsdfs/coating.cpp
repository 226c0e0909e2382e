// SPDX-License-Identifier: MIT

// [1] Weidlich and Wilkie 2007, "Arbitrarily Layered Micro-Facet Surfaces".

#include "bsdfs/fresnel.h"
#include "bsdfs/refraction_indices.h"
#include "model/plugin.h"
#include "plumb/math/elementary.h"
#include "plumb/model/bsdf.h"
#include "plumb/model/texture.h"

namespace plumb {

/// A smooth layer of varnish on another BSDF, on the front side: it mirrors, and what it lets in is refracted, reflected
/// below once, and refracted again [Weidlich and Wilkie 2007]. Light that is reflected back down inside the layer is lost.
///
///     intIOR                float              index of refraction of the layer, in [0.01, 100]                    (default 1.5046)
///     extIOR                float              index outside, in [0.01, 100]                                       (default 1.000277)
///     thickness             float              of the layer, in the unit of 1 / sigmaA, at least 0                 (default 1)
///     sigmaA                color              what is absorbed per unit of length in the layer, at least 0        (default 0)
///     specularReflectance   color or texture   multiplies the mirrored light, in [0, 1]                            (default 1)
///
///         <bsdf type="coating">
///             <float name="intIOR" value="1.7"/>
///             <color name="sigmaA" value="0.1 0.4 0.9"/>
///             <bsdf type="roughconductor">
///                 <float name="alpha" value="0.3"/>
///             </bsdf>
///         </bsdf>
class Coating final : public Bsdf {
public:
    explicit Coating(const Params& params)
        : eta_(RefractionIndices(params).eta()),
          absorbed_(params.color("sigmaA", Color(0.f)) *
                    params.number("thickness", 1.f, Range::at_least(0.0))),
          specular_(params.color_texture("specularReflectance", Color(1.f), Range::closed(0.0, 1.0))),
          below_(params.bsdf(0))
    {
        if (below_->lobes().has_any(transmission_lobes | Lobe::null) && params.bsdf_count() > 0)
            params.fail_bsdf(0, "must not let light through: the layer lies on an opaque surface");
    }

    Lobes lobes() const override { return Lobe::delta_reflection | below_->lobes(); }
    bool is_oriented() const override { return below_->is_oriented(); }
    bool has_back() const override { return false; }
    bool is_reciprocal() const override { return below_->is_reciprocal(); }
    bool conserves_energy() const override { return below_->conserves_energy(); }

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const override
    {
        if (!(wi.z > 0.f && wo.z > 0.f)) return {};
        const Side in = enter(wi), out = enter(wo);
        const auto [f_cos, pdf] = below_->evaluate(at, in.direction, out.direction);
        // By solid angle outside: d omega' = cos / (eta^2 cos') d omega. Radiance is divided by eta^2 on its way out and
        // multiplied by it on its way in.
        const float stretch = wo.z / (sqr(eta_) * out.direction.z);
        return {f_cos * transmitted(in, out) * stretch, pdf * (1.f - in.reflectance) * stretch};
    }

    // The mirror is chosen as often as it reflects.
    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const override
    {
        if (!(wi.z > 0.f)) return std::nullopt;
        const Side in = enter(wi);
        if (u_lobe < in.reflectance)
            return BsdfSample{
                {-wi.x, -wi.y, wi.z}, specular_->color(at), in.reflectance, Lobe::delta_reflection, 1.f};
        const float chance = 1.f - in.reflectance;
        if (!(chance > 0.f)) return std::nullopt;
        const float u_rest = std::min((u_lobe - in.reflectance) / chance, one_minus_epsilon);
        auto sampled = below_->sample(at, in.direction, u_rest, u);
        if (!sampled || !(sampled->wo.z > 0.f)) return std::nullopt;
        const Vec3f inside = sampled->wo;
        const float sine2 = sqr(eta_) * (sqr(inside.x) + sqr(inside.y));
        if (!(sine2 < 1.f)) return std::nullopt; // total internal reflection
        const Vec3f wo(eta_ * inside.x, eta_ * inside.y, std::sqrt(1.f - sine2));
        if (!sampled->is_delta()) {
            const auto [f_cos, pdf] = evaluate(at, wi, wo);
            if (!(pdf > 0.f)) return std::nullopt;
            return BsdfSample{wo, f_cos / pdf, pdf, sampled->lobe, 1.f};
        }
        return BsdfSample{wo, sampled->weight * transmitted(in, enter(wo)) * (1.f / chance),
                          sampled->pdf * chance, sampled->lobe, 1.f};
    }

private:
    // What becomes of a direction outside.
    struct Side {
        Vec3f direction; // inside the layer, away from the surface below it
        float reflectance = 1.f;
    };

    Side enter(const Vec3f& outside) const
    {
        const Refraction refraction = fresnel_dielectric(outside.z, eta_);
        const float inside = -refraction.cos_t;
        return {{outside.x / eta_, outside.y / eta_, std::max(inside, 1e-6f)},
                inside > 0.f ? refraction.reflectance : 1.f};
    }

    // In and out again, through the layer.
    Color transmitted(const Side& in, const Side& out) const
    {
        const float fraction = (1.f - in.reflectance) * (1.f - out.reflectance);
        const float paths = 1.f / in.direction.z + 1.f / out.direction.z; // in units of the thickness
        return Color(exp(-absorbed_.r * paths), exp(-absorbed_.g * paths), exp(-absorbed_.b * paths)) *
               fraction;
    }

    float eta_;
    Color absorbed_; // along the normal: the optical thickness
    std::shared_ptr<const ColorTexture> specular_;
    std::shared_ptr<const Bsdf> below_;
};

template std::unique_ptr<Bsdf> build<Coating>(const Params&);

} // namespace plumb
