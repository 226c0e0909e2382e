// SPDX-License-Identifier: MIT
#pragma once

// From what an OBJ file says to a mesh of triangles.

#include "plumb/shapes/mesh.h"
#include "shapes/obj/obj_scan.h"

namespace plumb {

// faces: of the file's chunks, in order; their indices must be in range. Of the materials, only of_primitive is set.
// Throws Error if no triangle has an area.
MeshData assemble_obj_mesh(ObjAttributes attributes, std::vector<ObjFaces> faces);

} // namespace plumb
