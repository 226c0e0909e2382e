// SPDX-License-Identifier: MIT
#pragma once

#include "plumb/model/params.h"

namespace plumb {

// From the space of a light that points somewhere to the world. There it is at the origin and points along +z, +y is up
// and +x left, as for cameras. The parameters position, direction or target, and toWorld, which is applied last.
Transform read_aim(const Params& params);

} // namespace plumb
