// SPDX-License-Identifier: MIT
#include "emitters/aim.h"

namespace plumb {

Transform read_aim(const Params& params)
{
    const Vec3f position = params.point("position", Vec3f(0.f));
    const bool has_target = params.has("target");
    const Vec3f given = params.vector("direction", Vec3f(0.f, 0.f, 1.f));
    const Vec3f direction = has_target ? params.point("target", Vec3f(0.f)) - position : given;
    const Transform to_world = params.transform("toWorld");
    if (!params.has("position") && !params.has("direction") && !has_target) return to_world;
    if (has_target && params.has("direction"))
        params.fail("target", "cannot be given together with direction");
    if (has_target && !(max_component(abs(direction)) > 0.f)) {
        params.fail("target", "must not be where the light stands");
        return to_world;
    }
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
