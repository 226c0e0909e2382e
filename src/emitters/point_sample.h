// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/model/emitter.h"

namespace plumb {

// What a light at a point sends to a receiver. towards: from the receiver to the light, of the squared length distance2 > 0.
// Its radiance is color times factor, in double precision: at a distance of 1e-20, 1 / distance^2 is no float, but its product
// with the intensity may be.
EmitterSample sample_of_point(const Vec3f& position, const Vec3d& towards, double distance2,
                              const Color& color, double factor);

} // namespace plumb
