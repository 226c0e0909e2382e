// SPDX-License-Identifier: MIT
#pragma once

// What BSDFs that bend the normal of the BSDF inside them have in common.

#include "plumb/model/bsdf.h"
#include "plumb/model/params.h"

namespace plumb {

// Light is scattered only where it is on the same side of the bent normal as of the surface's (bsdf.h).
// Parameters useShadowing and flipInvalidNormals, and the BSDF inside.
class BentNormal : public Bsdf {
public:
    Lobes lobes() const final { return lobes_; }
    bool is_oriented() const final { return true; }
    bool has_back() const final { return has_back_; }
    float opacity(const SurfacePoint& at) const final { return bsdf_->opacity(at); }
    bool conserves_energy() const final { return bsdf_->conserves_energy(); }
    bool is_reciprocal() const final { return false; } // its cosine is that of the bent normal

    BsdfValue evaluate(const SurfacePoint& at, const Vec3f& wi, const Vec3f& wo) const final;
    std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3f& wi, float u_lobe,
                                     const Vec2f& u) const final;

protected:
    explicit BentNormal(const Params& params);

private:
    // In the frame of the surface, any length, z > 0.
    virtual Vec3f bent_normal(const SurfacePoint& at) const = 0;
    Frame bent_frame(const SurfacePoint& at, const Vec3f& wi) const;
    float shadowing(const Vec3f& normal, const Vec3f& wo) const;

    std::shared_ptr<const Bsdf> bsdf_;
    Lobes lobes_;
    bool has_back_;
    bool use_shadowing_;
    bool flip_;
};

} // namespace plumb
