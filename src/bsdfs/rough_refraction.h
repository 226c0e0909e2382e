// SPDX-License-Identifier: MIT
#pragma once

// Refraction by microfacets, which BSDFs that transmit share.
//
// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".

#include "bsdfs/rough_reflection.h"

namespace plumb {

// Whether both cosines have the same sign; their product could underflow.
inline bool same_side(float a, float b)
{
    return a > 0.f ? b > 0.f : a < 0.f && b < 0.f;
}

struct RoughRefraction {
    float f_cos = 0.f; // transmittance included, and the scale of refracted radiance
    float pdf = 0.f;   // of wo, if wh is sampled as wi sees it and refracts with its transmittance; 0: black
};

// wi and wo lie on different sides of the surface. eta: interior / exterior, not 1.
inline RoughRefraction rough_refraction(const MicrofacetDistribution& microfacets, float eta, const Vec3f& wi,
                                        const Vec3f& wo)
{
    // [1], equation 16, in double precision: wi and wo nearly cancel where the indices are close.
    const double ratio = wi.z > 0.f ? 1.0 / static_cast<double>(eta) : static_cast<double>(eta);
    const Vec3d sum = Vec3d(wi) * ratio + Vec3d(wo);
    const double length_squared_of_sum = length_squared(sum);
    if (!(length_squared_of_sum > 0.0)) return {};
    const Vec3d half = sum * ((sum.z < 0.0 ? -1.0 : 1.0) / std::sqrt(length_squared_of_sum));
    const Vec3f wh(half);

    // Both directions must see their own side of the microfacet.
    const float cos_i = static_cast<float>(dot(Vec3d(wi), half));
    const float cos_o = static_cast<float>(dot(Vec3d(wo), half));
    if (!same_side(cos_i, wi.z) || !same_side(cos_o, wo.z)) return {};

    // The reflectance is the same from both sides. Near the critical angle only the thinner side's cosine keeps
    // its digits.
    const bool wi_in_thinner = (wi.z > 0.f) == (eta > 1.f);
    const float transmittance = 1.f - fresnel_dielectric(wi_in_thinner ? cos_i : cos_o, eta).reflectance;

    // [1], equations 17 and 21: the denominator (wi . wh eta_i + wo . wh eta_t)^2 / eta_t^2 is the squared length
    // of the sum above.
    const float d = microfacets.d(wh);
    const float jacobian = static_cast<float>(static_cast<double>(std::abs(cos_o)) / length_squared_of_sum);
    const float visible = std::abs(cos_i) / microfacets.visible_area(upwards(wi));
    const float pdf = transmittance * d * visible * jacobian;
    if (!(pdf > 0.f)) return {};
    const float g = microfacets.g(wi, wo, wh);
    const float scale = static_cast<float>(sqr(ratio));
    return {transmittance * d * jacobian * scale * (g * std::abs(cos_i) / std::abs(wi.z)), pdf};
}

} // namespace plumb
