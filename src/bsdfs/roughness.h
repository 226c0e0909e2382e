// SPDX-License-Identifier: MIT
#pragma once

// The microfacets of rough BSDFs, as their constructors read them.

#include "bsdfs/microfacet_distribution.h"
#include "plumb/model/params.h"
#include "plumb/model/texture.h"

namespace plumb {

// The smallest roughness that single precision renders well. Smaller ones count as this.
inline constexpr float min_alpha = 1e-4f;

inline MicrofacetDistribution::Kind microfacet_kind(const Params& params)
{
    return params.choice("distribution", "beckmann", {"beckmann", "ggx"}) == "ggx"
               ? MicrofacetDistribution::Kind::ggx
               : MicrofacetDistribution::Kind::beckmann;
}

// The same everywhere and in all directions: parameters alpha and distribution.
inline MicrofacetDistribution uniform_microfacets(const Params& params)
{
    const float alpha = std::max(params.number("alpha", 0.1f, Range::closed(0.0, 1.0)), min_alpha);
    return {microfacet_kind(params), alpha, alpha};
}

// Parameters alpha, alphaU, alphaV and distribution.
class Roughness {
public:
    explicit Roughness(const Params& params)
        : alpha_u_(params.number_texture("alpha", 0.1f, range())), kind_(microfacet_kind(params))
    {
        const bool has_u = params.has("alphaU"), has_v = params.has("alphaV");
        if (!has_u && !has_v) return;
        alpha_v_ = has_v ? params.number_texture("alphaV", 0.1f, range()) : alpha_u_;
        if (has_u) alpha_u_ = params.number_texture("alphaU", 0.1f, range());
        if (has_u && has_v && params.has("alpha"))
            params.fail("alpha", "has no effect where both alphaU and alphaV are given; remove it");
    }

    // Whether s of the shading frame matters (bsdf.h).
    bool is_oriented() const { return alpha_v_ != nullptr; }

    MicrofacetDistribution at(const SurfacePoint& point) const
    {
        const float u = std::max(alpha_u_->number(point), min_alpha);
        return {kind_, u, alpha_v_ ? std::max(alpha_v_->number(point), min_alpha) : u};
    }

private:
    static Range range() { return Range::closed(0.0, 1.0); }

    std::shared_ptr<const NumberTexture> alpha_u_;
    std::shared_ptr<const NumberTexture> alpha_v_; // null: as alpha_u_
    MicrofacetDistribution::Kind kind_;
};

} // namespace plumb
