// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/model/bsdf.h"
#include "plumb/scene/tracer.h"

namespace plumb {

// What a camera ray sees, for integrators without paths. Calls seen(at, fraction, opacity) for each surface, up to the first
// that nothing passes, and with null where the ray leaves the scene. fraction: how much of the ray arrives there; opacity:
// how much of that ends there.
template <class Seen>
void see_through(Tracer& tracer, Ray ray, const Seen& seen)
{
    float fraction = 1.f;
    for (RayKind kind = RayKind::camera;; kind = RayKind::bounce) {
        const auto hit = tracer.intersect(ray, kind);
        if (!hit) return seen(nullptr, fraction, 1.f);
        const float opacity = tracer.scene().has_null_surfaces() ? hit->bsdf->opacity(*hit) : 1.f;
        seen(&*hit, fraction, opacity);
        fraction *= 1.f - opacity;
        if (!(fraction > 0.f)) return;
        ray = hit->spawn_ray(ray.direction);
    }
}

} // namespace plumb
