// SPDX-License-Identifier: MIT
#pragma once

// Triangle meshes as data, and reading them from files. Materials of meshes: plumb/shapes/mtl.h.

#include "plumb/math/color.h"
#include "plumb/model/shape.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

// Values that a file gives vertices or faces under a name.
struct MeshAttribute {
    std::string name; // "vertex_color", "face_id": what the values belong to, and the name in the file
    bool per_face = false;
    std::uint32_t channels = 1; // 1 or 3
    std::vector<float> values;  // channels for each vertex, or for each triangle

    Color color(std::size_t i) const
    {
        if (channels == 1) return Color(values[i]);
        return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    }
};

struct MeshData {
    using Triangle = std::array<std::uint32_t, 3>;

    std::vector<Vec3f> positions; // object space; read_obj leaves room for one more: see AccelBuilder
    std::vector<Vec3f> normals;   // one a position and of unit length, or empty
    std::vector<Vec2f> uvs;       // one a position, or empty
    std::vector<Triangle> triangles;
    std::vector<MeshAttribute> attributes;
    FaceMaterials materials;
    std::string warning; // something odd that was repaired, or empty
};

// Reads v, vt, vn and f, and the names of materials (usemtl, mtllib); everything else is skipped. Triangles, quads (a b c d
// becomes a b c, a c d) and polygons, also concave ones; negative indices, corners p/ p// p/t/ that leave out what could
// follow, LF and CRLF line ends, lines that go on behind a backslash. Vertices are shared where the triple of indices is
// equal; those that no triangle uses are dropped. `warning` says so where
// - triangles have no area: they are left out;
// - some face corners have a normal and others none, or one of length zero: those get their face's normal;
// - some face corners have texture coordinates and others none: then all are left out.
// Throws FileError with file, line and column: unreadable, non-finite or huge numbers (above 1e18), indices out of
// range, faces with fewer than three corners; Error if the file cannot be read or
// holds no face with an area.
MeshData read_obj(const std::filesystem::path& path);

// Reads PLY files (ascii, and binary of both byte orders): of the element `vertex` x y z, nx ny nz, and u v, s t or
// texture_u texture_v; of `face` the list vertex_indices or vertex_index, of triangles, quads and polygons. Attributes:
// NAME_0, NAME_1 and NAME_2 (or NAME_r g b, NAME_x y z) become vertex_NAME or face_NAME; r g b, or red green blue, become
// vertex_color or face_color, integers among them divided by their largest value; NAME_0 alone has one channel. All else
// is skipped. `warning` and errors as for read_obj; errors in binary data name the vertex or face.
MeshData read_ply(const std::filesystem::path& path);

// Reads mesh number `index` of a Mitsuba .serialized file (versions 3 and 4): positions, normals, texture coordinates,
// vertex colours (as the attribute vertex_color) and triangles. `warning` and errors as for read_obj.
MeshData read_serialized(const std::filesystem::path& path, std::uint32_t index);

} // namespace plumb
