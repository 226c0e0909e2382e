// SPDX-License-Identifier: MIT
#pragma once

// What `check` says of scenes that lie so far from the origin that 32-bit floats cannot hold them.

#include "plumb/check/check.h"

namespace plumb {

// Floats are 2^-23 of a coordinate's power of two apart, and a ray starts up to about four such steps off a surface. That
// matters where a scene, what its camera sees, or an object is not many steps large.
std::vector<Doubt> precision_doubts(const RenderJob& job);

} // namespace plumb
