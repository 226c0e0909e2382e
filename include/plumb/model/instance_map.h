// SPDX-License-Identifier: MIT
#pragma once

// Where an instance stands: the affine map from the space of its group to the world, and back.
//
// Conventions. "Object space" is that of the group. The map is rounded to floats once, when it is made, and exact from then on;
// its inverse and all that is computed with the two is in double precision. A mirror keeps the front of a surface its front:
// normals go through the inverse transpose and are never flipped.

#include "plumb/math/transform.h"
#include "plumb/model/surface.h"

namespace plumb {

class InstanceMap {
public:
    // No direction becomes longer or shorter than by this factor, per axis: so rays stay in the range that can be traced.
    static constexpr double largest_scale = 1e9;

    InstanceMap() = default; // the identity
    // Nothing if the map, rounded to floats, is singular or scales by more than largest_scale or less than its inverse.
    static std::optional<InstanceMap> from(const Transform& to_world);

    // The same ray in object space. Its direction gets another length, so that t keeps its meaning.
    RayD to_object(const RayD& ray) const;
    // What tangents() of a shape needs of a point that moved to the world.
    SurfacePoint to_object(const SurfacePoint& at) const;

    Vec3d to_world(const Vec3d& point) const;
    Box3f to_world(const Box3f& box) const; // rounded outwards, around all that was in the box
    Tangents to_world(const Tangents& tangents) const;
    // A point that surface_at() returned for a ray in object space. around: the box of its primitive, in object space. Sets
    // everything but uv, primitive and what Scene adds.
    void move_to_world(SurfacePoint& at, const Box3f& around) const;
    // Of unit length; n: any length.
    Vec3d normal_to_world(const Vec3d& n) const;

    friend bool operator==(const InstanceMap& a, const InstanceMap& b) { return a.forward_ == b.forward_; }
    const std::array<std::array<float, 4>, 3>& rows() const { return forward_; }

private:
    Vec3d vector_to_world(const Vec3d& v) const;
    Vec3d through_inverse_transpose(const Vec3d& n) const;

    std::array<std::array<float, 4>, 3> forward_{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    std::array<std::array<double, 4>, 3> inverse_{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
};

} // namespace plumb
