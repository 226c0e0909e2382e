// SPDX-License-Identifier: MIT

#include "bsdfs/fresnel.h"

namespace plumb {

Refraction fresnel_dielectric(float cos_i, float eta)
{
    if (eta == 1.f) return {0.f, -cos_i, 1.f};
    const float ratio = cos_i > 0.f ? 1.f / eta : eta;

    // Snell's law, cos_t^2 = 1 - ratio^2 (1 - cos_i^2), in an order that loses nothing for cos_i or 1 - ratio near 0.
    const float cos_t_squared = (1.f - ratio) * (1.f + ratio) + sqr(ratio * cos_i);
    if (!(cos_t_squared > 0.f)) return {1.f, 0.f, ratio};

    // pbrt 4th ed., equation 9.6.
    const float i = std::abs(cos_i);
    const float t = std::sqrt(cos_t_squared);
    const float parallel = (i - ratio * t) / (i + ratio * t);
    const float perpendicular = (ratio * i - t) / (ratio * i + t);
    const float reflectance = 0.5f * (sqr(parallel) + sqr(perpendicular));
    return {std::min(reflectance, 1.f), std::copysign(t, -cos_i), ratio};
}

std::optional<Vec3f> refract(const Vec3f& wi, const Vec3f& normal, float eta)
{
    const float cos_i = dot(wi, normal);
    const Refraction refraction = fresnel_dielectric(cos_i, eta);
    if (refraction.cos_t == 0.f) return std::nullopt;
    const float along_normal = refraction.eta_ratio * cos_i + refraction.cos_t;
    return normalize(normal * along_normal - wi * refraction.eta_ratio);
}

} // namespace plumb
