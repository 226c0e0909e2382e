// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "shapes/triangle_mesh.h"

namespace plumb {

/// A triangle mesh from a PLY file: ascii, or binary of either byte order. Faces with more than three corners become
/// triangles.
///
/// Vertices have properties x y z; normals nx ny nz, and texture coordinates u v, s t, or texture_u texture_v, if they are
/// there. NAME_0, NAME_1 and NAME_2 (or NAME_r g b, NAME_x y z, or NAME_0 alone) of vertices and faces are attributes
/// with the names vertex_NAME and face_NAME; r g b or red green blue are vertex_color and face_color, where integers are
/// divided by their largest value.
///
/// The front side of a triangle, which emitters shine from, is the one that its vertex normals point to; without
/// normals, the one from which its corners run counter-clockwise. Normals are interpolated for shading; without
/// them the mesh is faceted, or `smooth`. Without texture coordinates, uv are the barycentric coordinates of the second
/// and third corner. toWorld may mirror: normals go through its inverse transpose, and the side follows them.
///
///     filename      string      the PLY file, relative to the scene file   (required)
///     toWorld       transform   from the file's coordinates to the world   (default: the identity)
///     smooth        boolean     if the file has no normals: those of the faces, averaged at each vertex with the angles
///                               that the faces have there   (default false)
///     faceNormals   boolean     faceted, and the normals of the file do not count   (default false)
///     flipV         boolean     texture coordinate v becomes 1 - v   (default false)
///     flipNormals   boolean     turn the front side to the back   (default false)
///
///         <shape type="ply">
///             <string name="filename" value="meshes/bust.ply"/>
///             <boolean name="smooth" value="true"/>
///         </shape>
class PlyMesh final : public TriangleMesh {
public:
    explicit PlyMesh(const Params& params) : TriangleMesh(params, read_ply) {}
};

template std::unique_ptr<Shape> build<PlyMesh>(const Params&);

} // namespace plumb
