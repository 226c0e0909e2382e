// SPDX-License-Identifier: MIT
#pragma once

// What lanes of lights are expected to send, where their normals are known to fill their cones.

#include "plumb/model/light_lanes.h"

namespace plumb {

// As LightLanes::importance(), and zero where that is, but with a mean of the cosine over the cone where that has its bound: for
// the parts of one surface, whose wide cones reach far around. A bound would choose those that face away too often.
LightLanes::Sums expected_importance(const LightLanes& lights, const LaneReceiver& receiver);

} // namespace plumb
