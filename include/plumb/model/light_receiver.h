// SPDX-License-Identifier: MIT
#pragma once

// Where light arrives.

#include "plumb/math/math.h"
#include "plumb/model/sky_view.h"

namespace plumb {

// As far as the choice among emitters, and among the parts of one, may depend on it. World space.
struct LightReceiver {
    Vec3f position{0.f};
    Vec3f normal{0.f};      // unit vector: only light from its side counts; zero: light from all around does
    bool is_glossy = false; // some directions count more than the cosine says
    SkyView sky = {};       // where light of an environment comes from

    // wi: towards the light, of any length.
    bool counts_light_from(const Vec3f& wi) const { return !(dot(wi, normal) < 0.f); }
};

} // namespace plumb
