// SPDX-License-Identifier: MIT

#include "plumb/math/direction_cone.h"

#include "plumb/math/elementary.h"

namespace plumb {
namespace {

// By how much an axis may turn when it is rounded to float.
constexpr double rounding_angle = 1e-6;

double angle_between(const Vec3d& a, const Vec3d& b)
{
    return atan2(length(cross(a, b)), dot(a, b));
}

} // namespace

DirectionCone hull(const DirectionCone& a, const DirectionCone& b)
{
    if (b.angle > a.angle) return hull(b, a);
    const Vec3d axis_a(a.axis);
    const Vec3d axis_b(b.axis);
    const double between = angle_between(axis_a, axis_b);
    if (between + b.angle <= a.angle) return a;

    // From the far side of one to the far side of the other; the axis of a turns towards that of b.
    const double angle = (a.angle + between + b.angle) * 0.5;
    const Vec3d side = axis_b - axis_a * dot(axis_a, axis_b);
    const double side_length = length(side);
    if (angle + rounding_angle >= pi_d || !(side_length > 0.0)) return {};
    const SinCosD turn = sin_cos(angle - a.angle);
    const Vec3d axis = axis_a * turn.cos + side * (turn.sin / side_length);
    return {Vec3f(normalize(axis)), angle + rounding_angle};
}

DirectionCone cone_about(const Vec3d& axis, double cosine)
{
    const double size = length(axis);
    if (!(size > 0.0)) return {};
    const double sine = std::sqrt(std::max((1.0 - cosine) * (1.0 + cosine), 0.0));
    return {Vec3f(axis / size), std::min(atan2(sine, cosine) + rounding_angle, pi_d)};
}

double mean_cosine(const DirectionCone& cone)
{
    const double cosine = sin_cos(cone.angle).cos;
    // The integral of the cosine over the cone, pi sin^2, up to pi for a hemisphere, over the solid angle 2 pi (1 - cos).
    return cosine >= 0.0 ? 0.5 * (1.0 + cosine) : 0.5 / (1.0 - cosine);
}

} // namespace plumb
