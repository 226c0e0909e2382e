// SPDX-License-Identifier: MIT
#pragma once

// A surface point of a path together with the direction that the path came from: where BSDFs are asked.

#include "plumb/model/bsdf.h"
#include "plumb/model/emitter.h"

namespace plumb {

// Conventions. wi and every wo here live in the shading frame, as in bsdf.h; *_world are in world space.
//
// Shading normals. The interpolated normal decides what a BSDF does, the geometry only where the next ray starts: where
// the two disagree about a direction's side, the path goes on as the BSDF says, through the surface if need be. So do
// the courses' renderers and pbrt. All techniques ask here, so all agree; flat normals never notice.
class Vertex {
public:
    Vertex(const SurfacePoint& at, const Vec3f& ray_direction)
        : at_(at), lobes_(at.bsdf->lobes()), wi_(at.shading.to_local(-ray_direction))
    {}

    // What is known of it here.
    void know_sky(const SkyView& sky) { sky_ = sky; }

    const SurfacePoint& at() const { return at_; }
    bool has_delta_lobes() const { return lobes_.has_any(delta_lobes); }
    bool is_glossy() const { return lobes_.has_any(glossy_lobes); }
    bool is_shiny() const { return are_shiny(lobes_); } // bsdf.h
    bool has_diffuse_lobes() const { return lobes_.has_any(Lobe::diffuse_reflection); }
    bool has_transmission() const { return lobes_.has_any(transmission_lobes); }
    // Whether evaluate() can be anything but black.
    bool has_smooth_lobes() const { return (lobes_.bits & ~delta_lobes.bits) != 0; }

    BsdfValue evaluate(const Vec3f& wo_world) const { return evaluate_local(at_.shading.to_local(wo_world)); }
    BsdfValue evaluate_local(const Vec3f& wo) const { return at_.bsdf->evaluate(at_, wi_, wo); }

    std::optional<BsdfSample> sample(float u_lobe, const Vec2f& u) const
    {
        return at_.bsdf->sample(at_, wi_, u_lobe, u);
    }

    // A direction above the surface, on the side that is seen.
    Vec3f on_seen_side(const Vec3f& up) const { return {up.x, up.y, wi_.z < 0.f ? -up.z : up.z}; }

    // A surface without smooth transmission is black, from where it is seen, for light samples from behind its shading normal.
    LightReceiver receiver() const
    {
        if (lobes_.has_any(Lobe::glossy_transmission)) return {at_.position, Vec3f(0.f), is_glossy(), sky_};
        return {at_.position, wi_.z < 0.f ? -at_.shading.n : at_.shading.n, is_glossy(), sky_};
    }

    // Whether the bounce is a link of chains (guided_path.h).
    bool is_link(const BsdfSample& sampled) const { return sampled.is_delta() || is_shiny(); }

    // Whether a sample goes on where the path came from, to rounding.
    bool goes_straight(const BsdfSample& sampled) const { return length_squared(sampled.wo + wi_) < 1e-10f; }

    Vec3f to_world(const BsdfSample& sampled) const { return at_.shading.to_world(sampled.wo); }

private:
    const SurfacePoint& at_;
    Lobes lobes_;
    Vec3f wi_;
    SkyView sky_;
};

} // namespace plumb
