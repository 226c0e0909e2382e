// SPDX-License-Identifier: MIT
#pragma once

// One BSDF for each face of a mesh. No plugin: what a mesh file says about materials decides.

#include "plumb/model/bsdf.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace plumb {

// of_primitive: for each primitive of the shape an index into bsdfs, none of which is null.
std::shared_ptr<const Bsdf> bsdf_by_face(std::vector<std::shared_ptr<const Bsdf>> bsdfs,
                                         std::vector<std::uint32_t> of_primitive);

} // namespace plumb
