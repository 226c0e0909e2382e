// SPDX-License-Identifier: MIT
#pragma once

// An orthonormal basis about a unit normal, and the trigonometry of directions in it (z is the normal).

#include "plumb/math.h"

namespace plumb {

struct Frame {
    Vec3f s{1.f, 0.f, 0.f};
    Vec3f t{0.f, 1.f, 0.f};
    Vec3f n{0.f, 0.f, 1.f};

    Frame() = default;

    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1), listing 3. normal: unit length.
    explicit Frame(const Vec3f& normal) : n(normal)
    {
        const float sign = std::copysign(1.f, n.z);
        const float a = -1.f / (sign + n.z);
        const float b = n.x * n.y * a;
        s = Vec3f(1.f + sign * n.x * n.x * a, sign * b, -sign * n.x);
        t = Vec3f(b, sign + n.y * n.y * a, -n.y);
    }

    // s points as far along `along` as a right angle to the normal allows; where that has no meaning (parallel, zero or
    // not finite), it is any direction. normal: unit length; along: any length.
    Frame(const Vec3f& normal, const Vec3f& along) : Frame(normal)
    {
        constexpr float parallel_below = 1e-12f; // squared sine of the angle
        const Vec3f projected = along - normal * dot(along, normal);
        const float size = dot(projected, projected);
        if (!(size > parallel_below * dot(along, along)) || !(size < infinity)) return;
        s = normalize(projected);
        t = cross(normal, s);
    }

    Vec3f to_local(const Vec3f& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
    Vec3f to_world(const Vec3f& v) const { return s * v.x + t * v.y + n * v.z; }
};

inline float cos_theta(const Vec3f& w)
{
    return w.z;
}

inline float abs_cos_theta(const Vec3f& w)
{
    return std::abs(w.z);
}

inline float sin_theta_squared(const Vec3f& w)
{
    return std::max(0.f, 1.f - w.z * w.z);
}

// Infinite at grazing directions.
inline float tan_theta_squared(const Vec3f& w)
{
    return sin_theta_squared(w) / (w.z * w.z);
}

inline bool same_hemisphere(const Vec3f& a, const Vec3f& b)
{
    return a.z > 0.f ? b.z > 0.f : a.z < 0.f && b.z < 0.f; // a product could underflow
}

} // namespace plumb
