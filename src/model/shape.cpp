// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"

namespace plumb {

std::optional<ShapeSample> Shape::sample_solid_angle(const Vec3f&, const Vec2f&) const
{
    return std::nullopt;
}

std::optional<float> Shape::solid_angle_pdf(const Vec3f&) const
{
    return std::nullopt;
}

std::optional<Color> Shape::attribute(std::string_view, const SurfacePoint&) const
{
    return std::nullopt;
}

} // namespace plumb
