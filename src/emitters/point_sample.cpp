// SPDX-License-Identifier: MIT
#include "emitters/point_sample.h"

namespace plumb {

EmitterSample sample_of_point(const Vec3f& position, const Vec3d& towards, double distance2,
                              const Color& color, double factor)
{
    const double distance = std::sqrt(distance2);
    EmitterSample sample;
    sample.wi = Vec3f(towards / distance);
    sample.distance = static_cast<float>(distance);
    sample.position = position;
    sample.radiance = Color(static_cast<float>(color.r * factor), static_cast<float>(color.g * factor),
                            static_cast<float>(color.b * factor));
    sample.pdf = 1.f;
    sample.is_delta = true;
    return sample;
}

} // namespace plumb
