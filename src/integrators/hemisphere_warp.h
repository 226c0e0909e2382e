// SPDX-License-Identifier: MIT
#pragma once

// Directions chosen on the hemisphere about the shading normal without asking the BSDF.

#include "integrators/vertex.h"
#include "plumb/params.h"
#include "plumb/sampler.h"
#include "plumb/sampling.h"

#include <string_view>

namespace plumb {

enum class HemisphereWarp { cosine, uniform };

// The parameter `name` of an integrator: cosine-hemisphere, uniform-hemisphere or none, which reads as cosine.
inline HemisphereWarp hemisphere_warp(const Params& params, std::string_view name)
{
    const std::string word = params.choice(name, "none", {"cosine-hemisphere", "uniform-hemisphere", "none"});
    return word == "uniform-hemisphere" ? HemisphereWarp::uniform : HemisphereWarp::cosine;
}

inline Vec3f sample_hemisphere(HemisphereWarp warp, const Vec2f& u)
{
    return warp == HemisphereWarp::cosine ? square_to_cosine_hemisphere(u) : square_to_uniform_hemisphere(u);
}

inline float hemisphere_pdf(HemisphereWarp warp, const Vec3f& w)
{
    return warp == HemisphereWarp::cosine ? cosine_hemisphere_pdf(w) : uniform_hemisphere_pdf(w);
}

// A bounce into a direction that the warp chose, on the side that is seen.
inline std::optional<BsdfSample> scatter_over_hemisphere(HemisphereWarp warp, Sampler& sampler,
                                                         const Vertex& vertex)
{
    const Vec3f up = sample_hemisphere(warp, sampler.next_2d());
    const float pdf = hemisphere_pdf(warp, up);
    if (!(pdf > 0.f)) return std::nullopt;
    const Vec3f wo = vertex.on_seen_side(up);
    const BsdfValue value = vertex.evaluate_local(wo);
    return BsdfSample{wo, value.f_cos / pdf, pdf};
}

// The same, except that BSDFs which the hemisphere cannot serve, discrete and transmitting ones, choose themselves.
inline std::optional<BsdfSample> scatter_by_warp(HemisphereWarp warp, Sampler& sampler, const Vertex& vertex)
{
    if (!vertex.has_discrete_lobes() && !vertex.has_transmission())
        return scatter_over_hemisphere(warp, sampler, vertex);
    const float u_lobe = sampler.next_1d();
    const Vec2f u = sampler.next_2d();
    return vertex.sample(u_lobe, u);
}

} // namespace plumb
