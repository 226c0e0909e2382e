// SPDX-License-Identifier: MIT
#pragma once

// Reflection and refraction at a smooth boundary, unpolarised light.
//
// Conventions. cos_i is the signed cosine between wi and the normal; eta = interior index / exterior index, the
// exterior being the side that the normal points to. Directions point away from the surface.

#include "plumb/math/color.h"
#include "plumb/math/math.h"

#include <optional>

namespace plumb {

struct Refraction {
    float reflectance; // in [0, 1]; 1 at total internal reflection
    float cos_t; // signed cosine of the refracted direction with the normal: opposite sign to cos_i; 0 at TIR
    float eta_ratio; // index of wi's side / index of the other side
};

// Exact Fresnel equations (pbrt 4th ed., equation 9.6), from either side.
Refraction fresnel_dielectric(float cos_i, float eta);

// Exact Fresnel equations for light from vacuum onto an index of refraction eta + i k (Born and Wolf 1999, section
// 14.2, in real numbers). cos_i, eta, k >= 0.
float fresnel_conductor(float cos_i, float eta, float k);

// The mean of 1 - reflectance over a hemisphere of directions on the outside, each weighted by its cosine over pi.
float mean_transmittance(float eta);

// wi refracted about the unit normal; nothing at total internal reflection. normal may lie on either side of wi.
std::optional<Vec3f> refract(const Vec3f& wi, const Vec3f& normal, float eta);

// wi mirrored about the unit normal.
inline Vec3f reflect(const Vec3f& wi, const Vec3f& normal)
{
    return normal * (2.f * dot(wi, normal)) - wi;
}

// Schlick 1994, equation 15: reflectance_0 + (1 - reflectance_0) (1 - cos)^5.
inline Color fresnel_schlick(float cos_i, const Color& reflectance_0)
{
    const float x = 1.f - std::clamp(cos_i, 0.f, 1.f);
    const float x5 = sqr(sqr(x)) * x;
    return reflectance_0 + (Color(1.f) - reflectance_0) * x5;
}

} // namespace plumb
