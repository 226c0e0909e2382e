// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"

#include "plumb/model/instance_map.h"

namespace plumb {

std::optional<ShapeSample> Shape::sample_solid_angle(const Vec3f&, const Vec2f&) const
{
    return std::nullopt;
}

std::optional<ShapeSample> Shape::sample_for(const LightReceiver&, double u_select, const Vec2f& u) const
{
    return sample_area(u_select, u);
}

double Shape::pdf_for(const LightReceiver&, std::uint32_t) const
{
    return 1.0 / static_cast<double>(area());
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
