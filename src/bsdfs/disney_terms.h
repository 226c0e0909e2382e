// SPDX-License-Identifier: MIT
#pragma once

// Terms of Disney's BSDFs.
//
// [1] Burley 2012, "Physically Based Shading at Disney".
// [2] Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering".

#include "bsdfs/microfacet_distribution.h"
#include "plumb/math/color.h"

namespace plumb::disney {

// Schlick 1994, equation 15: (1 - cos)^5.
inline float schlick_weight(float cosine)
{
    const float x = std::clamp(1.f - cosine, 0.f, 1.f);
    return sqr(sqr(x)) * x;
}

inline Color mix(const Color& a, const Color& b, float t)
{
    return a * (1.f - t) + b * t;
}

// The hue of a colour, of luminance 1.
inline Color tint_of(const Color& base)
{
    const float brightness = luminance(base);
    return brightness > 0.f ? base / brightness : Color(1.f);
}

// Reflectance along the normal.
inline float reflectance_0(float eta)
{
    return sqr((eta - 1.f) / (eta + 1.f));
}

// [1], section 5.4: GGX whose roughness is squared.
inline MicrofacetDistribution microfacets(float roughness, float anisotropic)
{
    constexpr float lowest = 1e-3f;
    const float aspect = std::sqrt(1.f - 0.9f * anisotropic);
    const float alpha = sqr(roughness);
    return {MicrofacetDistribution::Kind::ggx, std::max(lowest, alpha / aspect),
            std::max(lowest, alpha * aspect)};
}

// The factor of base / pi, times cos_o: [2], equation 4, diffuse with retro-reflection, mixed by `flatness` with a flat look after
// Hanrahan and Krueger, [1], section 5.3. cos_d: between the half vector and either direction.
inline float diffuse(float roughness, float flatness, float cos_i, float cos_o, float cos_d)
{
    const float in = schlick_weight(cos_i), out = schlick_weight(cos_o);
    const float retro = 2.f * roughness * sqr(cos_d);
    const float lambert = (1.f - 0.5f * in) * (1.f - 0.5f * out);
    const float back = retro * (in + out + in * out * (retro - 1.f));
    const float edge = 0.5f * retro;
    const float flat = lerp(1.f, edge, in) * lerp(1.f, edge, out);
    const float subsurface = 1.25f * (flat * (cos_o / (cos_i + cos_o) - 0.5f * cos_o) + 0.5f * cos_o);
    return lerp((lambert + back) * cos_o, subsurface, flatness);
}

// [1], section 5.5, without the cosine.
inline Color sheen(float sheen, float sheen_tint, const Color& tint, float cos_d)
{
    return mix(Color(1.f), tint, sheen_tint) * (sheen * schlick_weight(cos_d));
}

} // namespace plumb::disney
