// SPDX-License-Identifier: MIT
#pragma once

// Triangle meshes as data, and reading them from Wavefront OBJ files. src/shapes/obj/obj.cpp is tinyobjloader's only user.

#include "plumb/math/math.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct MeshData {
    using Triangle = std::array<std::uint32_t, 3>;

    std::vector<Vec3f> positions; // object space; read_obj leaves room for one more: see AccelBuilder
    std::vector<Vec3f> normals;   // one a position and of unit length, or empty
    std::vector<Vec2f> uvs;       // one a position, or empty
    std::vector<Triangle> triangles;
    std::string warning; // something odd that was repaired, or empty
};

// Reads v, vt, vn and f; everything else is skipped, and materials (usemtl) are counted. Triangles, quads (a b c d
// becomes a b c, a c d) and polygons, also concave ones; negative indices, corners p/ p// p/t/ that leave out what could
// follow, LF and CRLF line ends, lines that go on behind a backslash. Vertices are shared where the triple of indices is
// equal; those that no triangle uses are dropped. `warning` says so where
// - triangles have no area: they are left out;
// - some face corners have a normal and others none, or one of length zero: those get their face's normal;
// - some face corners have texture coordinates and others none: then all are left out;
// - the faces name several materials: a mesh has one BSDF.
// Throws FileError with file, line and column: unreadable, non-finite or huge numbers (above 1e18), indices out of
// range, faces with fewer than three corners; Error if the file cannot be read or
// holds no face with an area.
MeshData read_obj(const std::filesystem::path& path);

} // namespace plumb
