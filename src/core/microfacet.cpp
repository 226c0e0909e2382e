// SPDX-License-Identifier: MIT

// [1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".

#include "plumb/microfacet.h"

#include "plumb/elementary.h"

namespace plumb {

float Beckmann::d(const Vec3f& wh) const
{
    if (wh.z <= 0.f) return 0.f;

    // The tangent from x and y: 1 - z^2 has no digits left where the surface is smooth.
    const float cos_squared = sqr(wh.z);
    const float tan_squared = (sqr(wh.x) + sqr(wh.y)) / cos_squared;
    const float falloff = exp(-tan_squared / sqr(alpha_));
    if (falloff == 0.f) return 0.f;                         // and cos_squared may be 0, too
    return falloff / (pi * sqr(alpha_) * sqr(cos_squared)); // [1], equation 25
}

float Beckmann::g1(const Vec3f& v, const Vec3f& wh) const
{
    const float cos_h = dot(v, wh);
    if (!(v.z > 0.f ? cos_h > 0.f : v.z < 0.f && cos_h < 0.f)) return 0.f; // a product could underflow
    const float sine = std::sqrt(sqr(v.x) + sqr(v.y));
    const float a = std::abs(v.z) / (alpha_ * sine); // infinite along the normal
    if (!(a < 1.6f)) return 1.f;
    return (3.535f * a + 2.181f * sqr(a)) / (1.f + 2.276f * a + 2.577f * sqr(a)); // [1], equation 27
}

Vec3f Beckmann::sample(const Vec2f& u) const
{
    const float tan_squared = -sqr(alpha_) * log(1.f - u.x); // [1], equation 28
    const float cosine = 1.f / std::sqrt(1.f + tan_squared);
    const float sine = cosine * std::sqrt(tan_squared);
    const SinCos phi = sin_cos(two_pi * u.y); // [1], equation 29
    return {sine * phi.cos, sine * phi.sin, cosine};
}

float Beckmann::pdf(const Vec3f& wh) const
{
    return d(wh) * std::max(wh.z, 0.f);
}

} // namespace plumb
