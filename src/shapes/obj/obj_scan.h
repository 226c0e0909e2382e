// SPDX-License-Identifier: MIT
#pragma once

// Checks the text of an OBJ file and reads its numbers, chunk by chunk.
//
// tinyobjloader turns what it cannot read into 0, and rounds decimals with libm's pow; so numbers are read here, to
// the nearest float, and faces are passed on to it only when they were found to be in order.

#include "plumb/math/math.h"
#include "shapes/obj/obj_faces.h"
#include "shapes/obj/obj_materials.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct ObjCounts {
    std::size_t positions = 0;
    std::size_t uvs = 0;
    std::size_t normals = 0;
};

// Of the whole file.
struct ObjAttributes {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; // of unit length, or 0 as in the file
    std::vector<Vec2f> uvs;
};

struct ObjFile {
    std::string name;      // for messages
    std::string_view text; // ends with two line ends
};

// The largest index of one kind, and where it stands first.
struct ObjLargestIndex {
    std::int32_t value = 0;
    std::string_view at = {};
};

struct ObjChunk {
    ObjFaces faces;
    ObjLargestIndex position;
    ObjLargestIndex uv;
    ObjLargestIndex normal;
    ObjMaterials materials;
};

// How many of them the statements of `chunk` give.
ObjCounts count_obj(std::string_view chunk);

// chunk: whole statements of the file. before: what the lines in front of it give. The numbers go to their places in `found`,
// which other chunks may fill meanwhile. Throws FileError.
ObjChunk scan_obj(const ObjFile& file, std::string_view chunk, const ObjCounts& before, ObjAttributes& found);

// What can be told only when all chunks have been read: throws FileError for an index that is out of range, and Error
// for a file without faces.
void check_obj(const ObjFile& file, const std::vector<ObjChunk>& chunks, const ObjCounts& all);

} // namespace plumb
