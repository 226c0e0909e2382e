// SPDX-License-Identifier: MIT
#pragma once

// What `check` says of surfaces that lie in each other.

#include "plumb/check/check.h"

namespace plumb {

// Says nothing of opaque surfaces that lie back on front where one side of them is enclosed, as a box that stands on a
// floor encloses its bottom: no light gets there.
std::vector<Doubt> coincidence_doubts(const Scene& scene);

} // namespace plumb
