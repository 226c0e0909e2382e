// SPDX-License-Identifier: MIT
#pragma once

// Where a ray met the scene, and how to leave that place.

#include "plumb/math/frame.h"
#include "plumb/math/ray.h"

namespace plumb {

class Shape;
class Bsdf;
class Emitter;
class InstanceMap;

// Conventions. World space. geometric_normal has unit length and is the true normal of the surface, on the side
// that the shape calls its front (the side of the vertex normals where a mesh has them); shading.n is interpolated.
// clearance: how far along the geometric normal a ray must start, so as not to meet the same surface again (ray.h).
struct alignas(16) SurfacePoint {
    Vec3f position;
    float clearance = 0.f;
    Vec3f geometric_normal;
    std::uint32_t primitive = 0;
    Frame shading;
    std::uint32_t emitter_index = 0; // into the scene's emitters; meaningless without emitter
    Vec2f uv;
    const Shape* shape = nullptr;          // in the space of the group where there is an instance
    const Bsdf* bsdf = nullptr;            // never null at a point that Scene returns
    const Emitter* emitter = nullptr;      // null where nothing is emitted
    const InstanceMap* instance = nullptr; // null unless the shape is in an instance
    Vec2f barycentric{0.f};                // in a triangle: the weights of its second and third corner

    // A ray leaving in `direction` (any length), started off the surface on that side.
    Ray spawn_ray(const Vec3f& direction) const
    {
        return {offset_origin(position, clearance, geometric_normal, direction), direction, 0.f, infinity};
    }
};

// How the point of a surface moves with its uv coordinates. World space; neither of unit length nor perpendicular.
struct Tangents {
    Vec3f dp_du{0.f};
    Vec3f dp_dv{0.f};
};

} // namespace plumb
