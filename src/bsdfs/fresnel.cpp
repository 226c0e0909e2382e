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

float fresnel_conductor(float cos_i, float eta, float k)
{
    const double cos2 = sqr<double>(cos_i), sin2 = 1.0 - cos2;
    const double eta2 = sqr<double>(eta), k2 = sqr<double>(k);

    // a + i b = sqrt((eta + i k)^2 - sin^2), the index times the cosine inside.
    const double real = eta2 - k2 - sin2;
    const double size2 = std::sqrt(sqr(real) + 4.0 * eta2 * k2); // a^2 + b^2
    const double a = std::sqrt(std::max(0.5 * (size2 + real), 0.0));

    const double across = 2.0 * a * cos_i;
    const double perpendicular = (size2 + cos2 - across) / (size2 + cos2 + across);
    const double along = across * sin2;
    const double below = size2 * cos2 + sqr(sin2) + along;
    const double ratio =
        below > 0.0 ? (size2 * cos2 + sqr(sin2) - along) / below : 1.0; // parallel / perpendicular
    return std::clamp(static_cast<float>(0.5 * perpendicular * (1.0 + ratio)), 0.f, 1.f);
}

float mean_transmittance(float eta)
{
    // By midpoints, in the cosine of the side where no angle is critical, on which the integrand is smooth.
    // For eta < 1 the other side's mean is the same times eta^2, because the same light goes both ways.
    const float denser = std::max(eta, 1.f / eta);
    constexpr int steps = 512;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double root = (i + 0.5) / steps; // cosine = root^2: the slope is steep at grazing angles
        const auto cosine = static_cast<float>(sqr(root));
        const double reflected = fresnel_dielectric(cosine, denser).reflectance;
        sum += (1.0 - reflected) * 4.0 * root * sqr(root) / steps;
    }
    return static_cast<float>(eta >= 1.f ? sum : sum * sqr<double>(eta));
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
