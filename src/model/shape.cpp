// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"

#include "plumb/model/instance_map.h"

namespace plumb {

std::optional<ShapeSample> Shape::sample_solid_angle(const Vec3f&, const Vec2f&) const
{
    return std::nullopt;
}

std::optional<float> Shape::solid_angle_pdf(const Vec3f&) const
{
    return std::nullopt;
}

Tangents tangents_at(const SurfacePoint& at)
{
    if (at.instance == nullptr) return at.shape->tangents(at);
    return at.instance->to_world(at.shape->tangents(at.instance->to_object(at)));
}

} // namespace plumb
