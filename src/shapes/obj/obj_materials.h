// SPDX-License-Identifier: MIT
#pragma once

// The materials that the faces of an OBJ file name.

#include "plumb/model/shape.h"
#include "shapes/obj/obj_scan.h"

#include <span>

namespace plumb {

// The names that faces use, in the order of the file, and what `mtllib` lines name. The chunks' faces get their runs, unless
// all have the same material. Copies the text.
FaceMaterials number_materials(std::span<ObjChunk> chunks);

} // namespace plumb
