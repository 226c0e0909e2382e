// SPDX-License-Identifier: MIT

#include "bsdfs/rough_transmittance.h"

#include "bsdfs/fresnel.h"

namespace plumb {

namespace {

constexpr std::size_t directions = 64;

float cosine_of(std::size_t i)
{
    return std::max(static_cast<float>(i) / static_cast<float>(directions - 1), 1e-6f);
}

// The mean over the microfacets that are seen at this cosine.
template <class Value>
double mean_over_facets(const MicrofacetDistribution& microfacets, float cosine, const Value& value)
{
    constexpr int steps_along = 64, steps_across = 16;
    const Vec3f wi(std::sqrt((1.f - cosine) * (1.f + cosine)), 0.f, cosine);
    double sum = 0.0;
    for (int i = 0; i < steps_along; ++i)
        for (int j = 0; j < steps_across; ++j) {
            const Vec2f u((static_cast<float>(i) + 0.5f) / steps_along,
                          (static_cast<float>(j) + 0.5f) / steps_across);
            sum += static_cast<double>(value(wi, microfacets.sample_visible(wi, u)));
        }
    return sum / (steps_along * steps_across);
}

} // namespace

RoughTransmittance::RoughTransmittance(const MicrofacetDistribution& microfacets, float eta)
{
    const auto refracted = [&](const Vec3f& wi, const Vec3f& wh) {
        const std::optional<Vec3f> wo = refract(wi, wh, eta);
        if (!wo || !(wo->z < 0.f)) return 0.f;
        return (1.f - fresnel_dielectric(dot(wi, wh), eta).reflectance) * microfacets.g1(*wo, wh);
    };
    for (std::size_t i = 0; i < directions; ++i)
        values_[i] = static_cast<float>(mean_over_facets(microfacets, cosine_of(i), refracted));
}

float RoughTransmittance::at(float cosine) const
{
    const float place = std::clamp(cosine, 0.f, 1.f) * static_cast<float>(directions - 1);
    const auto before = std::min(static_cast<std::size_t>(place), directions - 2);
    return lerp(values_[before], values_[before + 1], place - static_cast<float>(before));
}

float mean_inside_reflectance(const MicrofacetDistribution& microfacets, float eta)
{
    const auto reflected = [&](const Vec3f& wi, const Vec3f& wh) {
        const Vec3f wo = reflect(wi, wh);
        if (!(wo.z > 0.f)) return 0.f;
        return fresnel_dielectric(dot(wi, wh), 1.f / eta).reflectance * microfacets.g1(wo, wh);
    };
    double sum = 0.0;
    for (std::size_t i = 0; i < directions; ++i)
        sum += 2.0 * cosine_of(i) * mean_over_facets(microfacets, cosine_of(i), reflected);
    return static_cast<float>(sum / directions);
}

} // namespace plumb
