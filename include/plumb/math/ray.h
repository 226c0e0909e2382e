// SPDX-License-Identifier: MIT
#pragma once

// A ray, and how to start one from a surface without meeting that surface again.
//
// Conventions. World space. Distances t count multiples of `direction`, which need not have unit length; a ray
// covers the open interval (t_min, t_max).

#include "plumb/math/math.h"

#include <bit>

namespace plumb {

// A vector and a number are stored together, here and in what functions return: what is written as four floats is read as
// four floats, or the processor would have to wait.
struct alignas(16) Ray {
    Ray() = default;
    Ray(const Vec3f& from, const Vec3f& along, float after = 0.f, float before = infinity)
        : origin(from), t_min(after), direction(along), t_max(before)
    {}

    Vec3f origin;
    float t_min = 0.f;
    Vec3f direction;
    float t_max = infinity;

    Vec3f at(float t) const { return origin + direction * t; }
};

// A ray in double precision: that of a float ray where an instance's map has moved it (model/instance_map.h), or the float ray
// itself.
struct RayD {
    RayD() = default;
    RayD(const Ray& ray) // NOLINT(google-explicit-constructor): the same ray
        : origin(ray.origin), direction(ray.direction), t_min(ray.t_min), t_max(ray.t_max)
    {}

    Vec3d origin{0.0};
    Vec3d direction{0.0};
    double t_min = 0.0;
    double t_max = static_cast<double>(infinity);
};

// Whether a ray can be traced: not a number, infinity and coordinates that add up to more than Embree's limit of a
// single one can not.
inline bool is_traceable(const Ray& ray)
{
    constexpr float limit = 1.8e18f;
    const auto sum = [](const Vec3f& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
    return sum(ray.origin) <= limit && sum(ray.direction) <= limit && ray.t_min >= 0.f &&
           ray.t_max >= ray.t_min;
}

// The next float above or below a finite x.
inline float next_float(float x, bool up)
{
    if (x == 0.f) return up ? std::numeric_limits<float>::min() : -std::numeric_limits<float>::min();
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>((x > 0.f) == up ? bits + 1 : bits - 1);
}

// How far along its surface's unit normal a point must be moved, so that neither its rounding nor the error of a
// ray-triangle test with it as origin finds that surface again. error: per axis, how far the point may be from the
// true surface; largest: per axis, the largest |coordinate| that it can have. As in pbrt 4th ed., section 6.8.6, the
// error box is left along the normal; here the box has been widened by what rounding the moved point can take back.
// The smallest number moves points with the coordinate 0 as well.
inline float clearance(const Vec3f& error, const Vec3f& largest, const Vec3f& normal)
{
    const Vec3f box = error + largest * (2.f * unit_roundoff);
    return dot(abs(normal), box) + std::numeric_limits<float>::min();
}

// How far along its surface's unit normal the end of a ray must lie, so that the ray does not meet that surface before
// its end. at_point: the clearance there, which is enough for rays that start at the surface; along: from the ray's
// origin to its end. Zero where there is no surface (normal = 0).
//
// From far away, the distance of the surface along the ray errs by roundings of the way and not of the coordinates. In
// units of unit_roundoff, and times |normal| per axis, as both sides of t = dot(corner - origin, n) / dot(direction, n)
// are sums along the normal: 4 for the way to the corner (1 for the difference, 3 for the products and their sum), 6 for
// the direction (1 for rounding it, 3 for the products and their sum, 2 for the division, which is a reciprocal and a
// product in Embree). That corners relative to a distant origin are rounded moves the plane by no more than that 1, even
// of slivers: between the corners, a plane is off by a mean of what they are off. The bound does not hold for a needle that
// is seen so nearly edge-on that its apparent height is below one rounding of the way: whether a ray meets it is then noise.
// tests/statistical/shadow_ray_test.cpp shows what is needed and what it costs.
inline float end_clearance(float at_point, const Vec3f& normal, const Vec3f& along)
{
    constexpr float way_factor = 10.f * unit_roundoff;
    return at_point + dot(abs(normal), abs(along)) * way_factor;
}

// Moves p off its surface to the side that `towards` points to.
inline Vec3f offset_origin(const Vec3f& p, float clearance, const Vec3f& normal, const Vec3f& towards)
{
    return p + normal * std::copysign(clearance, dot(towards, normal));
}

} // namespace plumb
