// SPDX-License-Identifier: MIT
#pragma once

// A surface point of a path together with the direction that the path came from: where BSDFs are asked.

#include "plumb/bsdf.h"

namespace plumb {

// Conventions. wi and every wo here live in the shading frame, as in bsdf.h; *_world are in world space.
//
// Shading normals. The geometry, not the interpolated normal, decides on which side of the surface a direction lies
// (Veach 1997, section 5.3.2): a BSDF gives nothing where its reflection would cross the true surface or its
// transmission would not. All techniques ask here, so all agree; a BSDF with flat normals never notices.
class Vertex {
public:
    Vertex(const SurfacePoint& at, const Vec3f& ray_direction)
        : at_(at),
          wi_(at.shading.to_local(-ray_direction)),
          wi_side_(-dot(at.geometric_normal, ray_direction))
    {}

    const SurfacePoint& at() const { return at_; }
    bool has_discrete_lobes() const { return lobes().has_any(delta_lobes); }
    bool has_transmission() const { return lobes().has_any(transmission_lobes); }
    // Whether evaluate() can be anything but black.
    bool has_smooth_lobes() const { return (lobes().bits & ~delta_lobes.bits) != 0; }

    BsdfValue evaluate(const Vec3f& wo, const Vec3f& wo_world) const
    {
        BsdfValue value = at_.bsdf->evaluate(at_, wi_, wo);
        if (!sides_agree(wo, wo_world)) value.f_cos = Color(0.f);
        return value;
    }
    BsdfValue evaluate(const Vec3f& wo_world) const
    {
        return evaluate(at_.shading.to_local(wo_world), wo_world);
    }

    std::optional<BsdfSample> sample(float u_lobe, Vec2f u) const
    {
        std::optional<BsdfSample> sampled = at_.bsdf->sample(at_, wi_, u_lobe, u);
        if (sampled && !sides_agree(sampled->wo, to_world(*sampled))) sampled.reset();
        return sampled;
    }

    Vec3f to_world(const BsdfSample& sampled) const { return at_.shading.to_world(sampled.wo); }

private:
    Lobes lobes() const { return at_.bsdf->lobes(); }

    bool sides_agree(const Vec3f& wo, const Vec3f& wo_world) const
    {
        return same_hemisphere(wi_, wo) == (wi_side_ * dot(at_.geometric_normal, wo_world) > 0.f);
    }

    const SurfacePoint& at_;
    Vec3f wi_;
    float wi_side_; // cosine between wi and the geometric normal
};

} // namespace plumb
