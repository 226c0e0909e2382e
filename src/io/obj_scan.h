// SPDX-License-Identifier: MIT
#pragma once

// Checks the text of an OBJ file and reads its numbers.
//
// tinyobjloader turns what it cannot read into 0, and rounds decimals with libm's pow; so numbers are read here, to
// the nearest float, and faces are passed on to it only when they were found to be in order.

#include "io/obj_faces.h"
#include "plumb/math.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct ObjAttributes {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; // as in the file: of any length
    std::vector<Vec2f> uvs;
};

// text: must end with a line end. file: its name, for messages. Closes the queue when it returns; throws FileError.
ObjAttributes scan_obj(const std::string& file, std::string_view text, ObjFaceQueue& queue);

} // namespace plumb
