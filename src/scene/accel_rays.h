// SPDX-License-Identifier: MIT
#pragma once

// Rays on their way to Embree and back.

#include "plumb/math/ray.h"

#include <cstring>

#if PLUMB_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace plumb {

// Embree accepts hits at exactly t_min; ours is an open interval, and a ray that starts in a plane must not meet it.
inline constexpr float smallest_t = std::numeric_limits<float>::min();

// Four floats that are stored as one: Embree loads them so, and after single stores it would have to wait.
inline void store(float* to, float x, float y, float z, float w)
{
    using Lanes [[gnu::vector_size(16)]] = float;
    const Lanes lanes{x, y, z, w};
    std::memcpy(to, &lanes, sizeof(lanes));
}

inline RTCRay embree_ray(const Ray& ray)
{
    RTCRay r;
    store(&r.org_x, ray.origin.x, ray.origin.y, ray.origin.z, std::max(ray.t_min, smallest_t));
    store(&r.dir_x, ray.direction.x, ray.direction.y, ray.direction.z, 0.f); // and the time
    r.tfar = ray.t_max;
    r.mask = ~0u;
    r.id = 0;
    r.flags = 0;
    return r;
}

inline Ray our_ray(const RTCRay& r)
{
    return {{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, r.tnear, r.tfar};
}

inline RTCRayHit intersect_scene(RTCScene scene, const RTCRay& ray)
{
    RTCRayHit ray_hit;
    ray_hit.ray = ray;
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if PLUMB_EMBREE_MAJOR >= 4
    rtcIntersect1(scene, &ray_hit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray_hit);
#endif
    return ray_hit;
}

inline bool is_occluded(RTCScene scene, RTCRay ray)
{
#if PLUMB_EMBREE_MAJOR >= 4
    rtcOccluded1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
    return ray.tfar < 0.f;
}

inline void store_bounds(RTCBounds& to, const Box3f& box)
{
    to.lower_x = next_float(box.min.x, false);
    to.lower_y = next_float(box.min.y, false);
    to.lower_z = next_float(box.min.z, false);
    to.upper_x = next_float(box.max.x, true);
    to.upper_y = next_float(box.max.y, true);
    to.upper_z = next_float(box.max.z, true);
}

// Throws Error if Embree has reported a failure since the last call.
void throw_device_error(const char* doing);

} // namespace plumb
