// SPDX-License-Identifier: MIT
#pragma once

// Shapes of the scene language that are not surfaces themselves: a group of shapes, and an instance of one. The loader reads
// what is in them (scene_file/groups.h).

#include "plumb/math/transform.h"

namespace plumb {

struct Composite {
    virtual ~Composite() = default;
    Transform to_world; // of an instance
};

} // namespace plumb
