// SPDX-License-Identifier: MIT

#include "plumb/model/light_lanes.h"

#include "model/light_estimate.h"
#include "plumb/math/elementary.h"

#include <cmath>

namespace plumb {
namespace {

// What rounding may take from the cosine between a light's normal and the receiver; and the same at the receiver, where
// surfaces that are not diffuse send on more of the light that grazes them than the cosine says.
constexpr float emission_margin = 1e-3f;
constexpr float reception_margin = 0.02f;

// The cosine of the angle that is left of a by b: cos(max(a - b, 0)).
inline float cosine_of_rest(float cos_a, float sin_a, float cos_b, float sin_b)
{
    return cos_a > cos_b ? 1.f : cos_a * cos_b + sin_a * sin_b;
}

// And its sine.
inline float sine_of_rest(float cos_a, float sin_a, float cos_b, float sin_b)
{
    return cos_a > cos_b ? 0.f : sin_a * cos_b - cos_a * sin_b;
}

inline float sine_of(float cosine)
{
    return std::sqrt(std::max((1.f - cosine) * (1.f + cosine), 0.f));
}

// emission_of(bound, middle, far): what is taken for the cosine at the lights, given its bound and those between the receiver
// and the middle and the far side of the cone.
template <class Emission>
LightLanes::Sums sums(const LightLanes& lights, const LaneReceiver& receiver, const Emission& emission_of)
{
    constexpr std::size_t width = LightLanes::width;
    const auto& [x, y, z, radius, axis_x, axis_y, axis_z, cosine, sine, intensity] = lights;
    constexpr float nearest = 1e-24f; // squared distance: its inverse is far from overflowing
    LightLanes::Lanes importance;
    for (std::size_t k = 0; k < width; ++k) {
        const float dx = x[k] - receiver.position.x;
        const float dy = y[k] - receiver.position.y;
        const float dz = z[k] - receiver.position.z;
        const float distance2 = std::max(dx * dx + dy * dy + dz * dz, nearest);
        const float radius2 = radius[k] * radius[k];
        const float inverse = 1.f / std::sqrt(distance2);

        // The sphere is seen within an angle b of its centre.
        const float sin_b = std::min(radius[k] * inverse, 1.f);
        const float cos_b = sine_of(sin_b);

        // [1], equation 12.32: no light leaves at less than the angle w - o - b to a normal, where w is the angle
        // between the axis and the receiver and o that of the cone.
        const float cos_w = -(axis_x[k] * dx + axis_y[k] * dy + axis_z[k] * dz) * inverse;
        const float sin_w = sine_of(cos_w);
        const float cos_x = cosine_of_rest(cos_w, sin_w, cosine[k], sine[k]);
        const float sin_x = sine_of_rest(cos_w, sin_w, cosine[k], sine[k]);
        const float emission = cosine_of_rest(cos_x, sin_x, cos_b, sin_b);

        // Nor does it arrive at less than the angle i - b to the receiver's normal.
        const float cos_i =
            (receiver.normal.x * dx + receiver.normal.y * dy + receiver.normal.z * dz) * inverse +
            receiver.any_side;
        const float reception = cosine_of_rest(cos_i, sine_of(cos_i), cos_b, sin_b);

        const bool inside = distance2 <= radius2;
        const float cosines = inside ? 1.f
                                     : emission_of(std::max(emission + emission_margin, 0.f), cos_w,
                                                   cos_w * cosine[k] - sin_w * sine[k]) *
                                           std::max(reception + reception_margin, 0.f);
        // Inside, the light is no nearer than it would be from the sphere's surface.
        importance[k] = intensity[k] * cosines / std::max(distance2, radius2);
    }
    LightLanes::Sums ends;
    ends[0] = 0.0;
    for (std::size_t k = 0; k < width; ++k) ends[k + 1] = ends[k] + static_cast<double>(importance[k]);
    return ends;
}

} // namespace

void LightLanes::set_box(std::size_t lane, const Box3f& box, const Space& space)
{
    const Vec3d low = (Vec3d(box.min) - space.origin) * space.scale;
    const Vec3d high = (Vec3d(box.max) - space.origin) * space.scale;
    const Vec3f center((low + high) * 0.5);
    const Vec3d to_low = Vec3d(center) - low;
    const Vec3d to_high = high - Vec3d(center);
    const Vec3d furthest(std::max(to_low.x, to_high.x), std::max(to_low.y, to_high.y),
                         std::max(to_low.z, to_high.z));
    x[lane] = center.x;
    y[lane] = center.y;
    z[lane] = center.z;
    radius[lane] = static_cast<float>(length(furthest) * (1.0 + 2.0 * unit_roundoff));
}

void LightLanes::set_normal(std::size_t lane, const Vec3f& normal)
{
    axis_x[lane] = normal.x;
    axis_y[lane] = normal.y;
    axis_z[lane] = normal.z;
    cosine[lane] = 1.f;
    sine[lane] = 0.f;
}

void LightLanes::set(std::size_t lane, const LightBounds& bounds, const Space& space, double unit)
{
    set_box(lane, bounds.box, space);
    set_normal(lane, bounds.normals.axis);
    const SinCosD angle = sin_cos(bounds.normals.angle);
    cosine[lane] = static_cast<float>(angle.cos);
    sine[lane] = static_cast<float>(std::max(angle.sin, 0.0));
    intensity[lane] = static_cast<float>(bounds.power / unit * mean_cosine(bounds.normals));
}

LightLanes::Sums LightLanes::importance(const LaneReceiver& receiver) const
{
    return sums(*this, receiver, [](float bound, float, float) { return bound; });
}

LightLanes::Sums expected_importance(const LightLanes& lights, const LaneReceiver& receiver)
{
    // Simpson's rule over the angles from w - o - b to w + o.
    return sums(lights, receiver, [](float bound, float middle, float far) {
        return (bound + 4.f * std::max(middle, 0.f) + std::max(far, 0.f)) * (1.f / 6.f);
    });
}

bool LightLanes::looks_alike(std::size_t lane, const LaneReceiver& receiver) const
{
    // The sphere is seen within an angle b of its centre, the normals are within o of the axis, which is at the angle w to the
    // receiver: the cosine there lies in cos(w) -+ (sin(b) + sin(o)), and at the receiver in cos(i) -+ sin(b).
    constexpr float tolerance = 0.125f;
    const Vec3f towards = Vec3f(x[lane], y[lane], z[lane]) - receiver.position;
    const float distance = std::sqrt(length_squared(towards));
    const float emission = -dot(Vec3f(axis_x[lane], axis_y[lane], axis_z[lane]), towards);
    const float reception = dot(receiver.normal, towards) + receiver.any_side * distance;
    return cosine[lane] > 0.f && radius[lane] + sine[lane] * distance <= tolerance * emission &&
           radius[lane] <= tolerance * reception;
}

LightBounds merged(const LightBounds& a, const LightBounds& b)
{
    if (a.box.isEmpty()) return b;
    if (b.box.isEmpty()) return a;
    LightBounds both{a.box, a.power + b.power, hull(a.normals, b.normals)};
    both.box.extendBy(b.box);
    return both;
}

} // namespace plumb
