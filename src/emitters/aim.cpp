// SPDX-License-Identifier: MIT
#include "emitters/aim.h"

namespace plumb {

Transform read_aim(const Params& params)
{
    const Vec3f position = params.point("position", Vec3f(0.f));
    const Vec3f direction = params.vector("direction", Vec3f(0.f, 0.f, 1.f));
    const Transform to_world = params.transform("toWorld");
    if (!params.has("position") && !params.has("direction")) return to_world;
    if (!(max_component(abs(direction)) > 0.f)) {
        params.fail("direction", "must not be 0: it is where the light goes");
        return to_world;
    }
    const Vec3d towards = normalize(Vec3d(normalize(direction)));
    const bool is_upright = std::abs(towards.y) > 0.999;
    const auto turn =
        Transform::look_at(Vec3d(0.0), towards, is_upright ? Vec3d(0.0, 0.0, 1.0) : Vec3d(0.0, 1.0, 0.0));
    return to_world * Transform::translate(Vec3d(position)) * *turn;
}

} // namespace plumb
