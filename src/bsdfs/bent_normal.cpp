// SPDX-License-Identifier: MIT

// [1] Estevez, Lecocq and Stein 2019, "A Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem".

#include "bsdfs/bent_normal.h"

namespace plumb {

BentNormal::BentNormal(const Params& params)
    : bsdf_(params.bsdf(0)),
      lobes_(bsdf_->lobes()),
      has_back_(bsdf_->has_back()),
      use_shadowing_(params.boolean("useShadowing", false)),
      flip_(params.boolean("flipInvalidNormals", true))
{}

BsdfValue BentNormal::evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const
{
    const Frame bent = bent_frame(at, wi);
    const Vec3f bent_wi = bent.to_local(wi), bent_wo = bent.to_local(wo);
    if (!same_hemisphere(wi, bent_wi) || !same_hemisphere(wo, bent_wo)) return {};
    BsdfValue value = bsdf_->evaluate(at, bent_wi, bent_wo);
    if (use_shadowing_) value.f_cos *= shadowing(bent.n, wo);
    return value;
}

std::optional<BsdfSample> BentNormal::sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                             const Vec2f& u) const
{
    const Frame bent = bent_frame(at, wi);
    const Vec3f bent_wi = bent.to_local(wi);
    if (!same_hemisphere(wi, bent_wi)) return std::nullopt; // in the surface
    auto sampled = bsdf_->sample(at, bent_wi, u_lobe, u);
    if (!sampled) return sampled;
    const Vec3f wo = normalize(bent.to_world(sampled->wo));
    if (!same_hemisphere(wo, sampled->wo)) return std::nullopt;
    sampled->wo = wo;
    if (use_shadowing_ && !sampled->is_pass()) sampled->weight *= shadowing(bent.n, wo);
    return sampled;
}

// In the frame of the surface. Unless it lies in it, wi is on the same side of its normal as of the surface's if flipped.
Frame BentNormal::bent_frame(const SurfacePoint& at, const Vec3f& wi) const
{
    Vec3f m = normalize(bent_normal(at));
    if (flip_ && !same_hemisphere(Vec3f(0.f, 0.f, dot(m, wi)), wi)) m = Vec3f(-m.x, -m.y, m.z);
    return Frame(m, Vec3f(1.f, 0.f, 0.f));
}

// [1], equations 1 to 3: the shadowing of GGX microfacets whose roughness follows the tilt of the normal.
float BentNormal::shadowing(const Vec3f& normal, const Vec3f& wo) const
{
    const float alpha_squared = std::clamp(0.125f * tan_theta_squared(normal), 0.f, 1.f);
    return 2.f / (1.f + std::sqrt(1.f + alpha_squared * tan_theta_squared(wo)));
}

} // namespace plumb
