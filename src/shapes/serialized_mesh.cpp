// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "shapes/triangle_mesh.h"

namespace plumb {

/// A triangle mesh from a .serialized file of Mitsuba (versions 3 and 4), which may hold several.
///
/// Colours of vertices are the attribute vertex_color. The front side of a triangle, which emitters shine from, is the one
/// that its vertex normals point to; without normals, the one from which its corners run counter-clockwise. Normals are
/// interpolated for shading; without them the mesh is faceted, or `smooth`. Without texture coordinates, uv are the
/// barycentric coordinates of the second and third corner. toWorld may mirror: normals go through its inverse transpose,
/// and the side follows them.
///
///     filename      string      the .serialized file, relative to the scene file   (required)
///     shapeIndex    integer     which mesh of the file, from 0   (default 0)
///     toWorld       transform   from the file's coordinates to the world   (default: the identity)
///     smooth        boolean     if the file has no normals: those of the faces, averaged at each vertex with the angles
///                               that the faces have there   (default false)
///     faceNormals   boolean     faceted, and the normals of the file do not count   (default false)
///     flipV         boolean     texture coordinate v becomes 1 - v   (default false)
///     flipNormals   boolean     turn the front side to the back   (default false)
///
///         <shape type="serialized">
///             <string name="filename" value="meshes/kitchen.serialized"/>
///             <integer name="shapeIndex" value="0"/>
///         </shape>
class SerializedMesh final : public TriangleMesh {
public:
    explicit SerializedMesh(const Params& params) : TriangleMesh(params, reader(params)) {}

private:
    static Read reader(const Params& params)
    {
        const std::int64_t index = params.integer("shapeIndex", 0, Range::closed(0, 4294967295.0));
        return [index](const std::filesystem::path& path) {
            return read_serialized(path, static_cast<std::uint32_t>(index));
        };
    }
};

template std::unique_ptr<Shape> build<SerializedMesh>(const Params&);

} // namespace plumb
