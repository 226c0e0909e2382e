// SPDX-License-Identifier: MIT
#pragma once

// Checks the text of an OBJ file and reads its numbers, chunk by chunk.
//
// Numbers are rounded to the nearest float.

#include "plumb/math/math.h"
#include "shapes/obj/obj_faces.h"

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

// `usemtl`: the material of the faces that follow.
struct ObjMaterialUse {
    std::size_t first_face = 0; // of the chunk
    std::string_view name;      // in the file's text
};

struct ObjChunk {
    ObjFaces faces;
    ObjLargestIndex position;
    ObjLargestIndex uv;
    ObjLargestIndex normal;
    std::vector<ObjMaterialUse> materials;
    std::vector<std::string_view> libraries; // what stands behind `mtllib`
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
