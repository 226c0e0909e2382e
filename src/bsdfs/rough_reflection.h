// SPDX-License-Identifier: MIT
#pragma once

// Reflection by microfacets, which the rough BSDFs share; Fresnel is theirs to multiply.
//
// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".

#include "bsdfs/fresnel.h"
#include "bsdfs/microfacet_distribution.h"

namespace plumb {

// Microfacets seen from behind are those seen from the opposite direction.
inline Vec3f upwards(const Vec3f& v)
{
    return v.z < 0.f ? -v : v;
}

struct RoughReflection {
    float cos_h;  // wi . wh = wo . wh, signed like wi.z: what Fresnel's equations take
    float dg_cos; // D G |cos_o| / (4 |cos_i cos_o|): times Fresnel, [1], equation 20, with the cosine
    float pdf;    // of wo if wh is sampled as wi sees it: D / (4 visible area), [1], equation 14
};

// wi and wo lie on one side of the surface.
inline RoughReflection rough_reflection(const MicrofacetDistribution& microfacets, const Vec3f& wi,
                                        const Vec3f& wo)
{
    // [1], equation 13. The length of the sum is twice the cosine, the same whichever way light goes.
    const Vec3d sum = Vec3d(wi) + Vec3d(wo);
    const double sum_length = length(sum);
    const Vec3f wh(sum * (std::copysign(1.0, sum.z) / sum_length));
    const auto cos_h = static_cast<float>(0.5 * sum_length);

    const float d = microfacets.d(wh);
    const float g_over_cosine = microfacets.g(wi, wo, wh) / (4.f * std::abs(wi.z));
    return {std::copysign(cos_h, wi.z), d * g_over_cosine, d / (4.f * microfacets.visible_area(upwards(wi)))};
}

} // namespace plumb
