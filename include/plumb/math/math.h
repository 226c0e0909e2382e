// SPDX-License-Identifier: MIT
#pragma once

// The vector vocabulary: Imath types under our names, and the few functions that shading code is written in.
//
// Conventions. Vectors are columns of three floats; angles are radians. Imath's operators ^ and % (dot and cross)
// are never used: dot() and cross() are. Double-precision vectors (Vec3d) serve where a hit point or a barycentric
// coordinate is computed; everything stored is float.

#include <Imath/ImathBox.h>
#include <Imath/ImathVec.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace plumb {

using Vec2f = Imath::V2f;
using Vec2d = Imath::V2d;
using Vec2i = Imath::V2i;
using Vec3f = Imath::V3f;
using Vec3d = Imath::V3d;
using Box3f = Imath::Box3f;

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float two_pi = 6.28318530717958647693f;
inline constexpr float half_pi = 1.57079632679489661923f;
inline constexpr float inv_pi = 0.31830988618379067154f;
inline constexpr float inv_two_pi = 0.15915494309189533577f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr double pi_d = 3.14159265358979323846;

// The largest float below 1: uniform random numbers lie in [0, one_minus_epsilon].
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

// Half a unit in the last place of 1: the relative error of one rounded float operation.
inline constexpr float unit_roundoff = 0x1p-24f;

template <class T>
constexpr T sqr(T x)
{
    return x * x;
}

inline float lerp(float a, float b, float t)
{
    return (1.f - t) * a + t * b;
}

// condition ? a : b, without a jump: for where the condition is a matter of chance, and no processor guesses that.
inline float select(bool condition, float a, float b)
{
    const auto mask = -static_cast<std::uint32_t>(condition);
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

// sqrt of a number that rounding may have pushed below 0.
inline float safe_sqrt(float x)
{
    return std::sqrt(std::max(x, 0.f));
}

template <class T>
T dot(const Imath::Vec3<T>& a, const Imath::Vec3<T>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
Imath::Vec3<T> cross(const Imath::Vec3<T>& a, const Imath::Vec3<T>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline float abs_dot(const Vec3f& a, const Vec3f& b)
{
    return std::abs(dot(a, b));
}

template <class T>
T length_squared(const Imath::Vec3<T>& v)
{
    return dot(v, v);
}

template <class T>
T length(const Imath::Vec3<T>& v)
{
    return std::sqrt(dot(v, v));
}

// v scaled to unit length; v must not be zero. The sum of squares is taken in double, so that neither tiny nor
// huge vectors under- or overflow.
inline Vec3f normalize(const Vec3f& v)
{
    const Vec3d d(v);
    const double scale = 1.0 / std::sqrt(dot(d, d));
    return Vec3f(static_cast<float>(d.x * scale), static_cast<float>(d.y * scale),
                 static_cast<float>(d.z * scale));
}

inline Vec3d normalize(const Vec3d& v)
{
    return v * (1.0 / std::sqrt(dot(v, v)));
}

inline Vec3f abs(const Vec3f& v)
{
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

inline float max_component(const Vec3f& v)
{
    return std::max({v.x, v.y, v.z});
}

inline bool is_finite(const Vec3f& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace plumb
