// SPDX-License-Identifier: MIT
#pragma once

// Triangle meshes as data, and reading them from Wavefront OBJ files. src/io/obj.cpp is tinyobjloader's only user.

#include "plumb/math.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct MeshData {
    using Triangle = std::array<std::uint32_t, 3>;

    std::vector<Vec3f> positions; // object space
    std::vector<Vec3f> normals;   // one a position and of unit length, or empty
    std::vector<Vec2f> uvs;       // one a position, or empty
    std::vector<Triangle> triangles;
    std::string warning; // something odd that was repaired, or empty
};

// Reads v, vt, vn and f; everything else is skipped. Triangles, quads (a b c d becomes a b c, a c d) and polygons,
// negative indices, LF and CRLF line ends. Vertices are shared where the triple of indices is equal. Normals (uvs)
// are kept if every face corner has one; if only some have, they are dropped and `warning` says so.
// Throws FileError with file, line and column: unreadable or non-finite numbers, indices out of range, faces with
// fewer than three corners, no faces at all; Error if the file cannot be read.
MeshData read_obj(const std::filesystem::path& path);

} // namespace plumb
