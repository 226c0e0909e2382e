// SPDX-License-Identifier: MIT
#pragma once

// A ray, and how to start one from a surface without meeting that surface again.
//
// Conventions. World space. Distances t count multiples of `direction`, which need not have unit length; a ray
// covers the open interval (t_min, t_max).

#include "plumb/math.h"

#include <bit>

namespace plumb {

struct Ray {
    Vec3f origin;
    Vec3f direction;
    float t_min = 0.f;
    float t_max = infinity;

    Vec3f at(float t) const { return origin + direction * t; }
};

// Whether a ray can be traced: not a number, infinity and coordinates beyond 1e18 can not (Embree's own limit is 1.8e18).
inline bool is_traceable(const Ray& ray)
{
    constexpr float limit = 1e18f;
    const auto within = [](const Vec3f& v) {
        return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
    };
    return within(ray.origin) && within(ray.direction) && ray.t_min >= 0.f && ray.t_max >= ray.t_min;
}

// The next float above or below a finite x.
inline float next_float(float x, bool up)
{
    if (x == 0.f) return up ? std::numeric_limits<float>::min() : -std::numeric_limits<float>::min();
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>((x > 0.f) == up ? bits + 1 : bits - 1);
}

// Moves p off its surface to the side that `towards` points to, so that neither the rounding of p nor the error of
// a ray-triangle test with p as origin finds that surface again. error: per axis, how far p may be from the true
// surface. The offset follows pbrt 4th ed., section 6.8.6: the error box is left along the normal, then each
// coordinate is rounded away from the surface.
inline Vec3f offset_origin(const Vec3f& p, const Vec3f& error, const Vec3f& normal, const Vec3f& towards)
{
    const float distance = dot(abs(normal), error);
    const float side = dot(towards, normal) < 0.f ? -1.f : 1.f;
    const Vec3f moved = p + normal * (side * distance);
    const auto round_away = [side](float x, float n) { return n == 0.f ? x : next_float(x, side * n > 0.f); };
    return {round_away(moved.x, normal.x), round_away(moved.y, normal.y), round_away(moved.z, normal.z)};
}

} // namespace plumb
