// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "shapes/triangle_mesh.h"

namespace plumb {

/// A triangle mesh from a Wavefront OBJ file. Faces with more than three corners become triangles.
///
/// The front side of a triangle, which emitters shine from, is the one that its vertex normals point to; without
/// normals, the one from which its corners run counter-clockwise. Normals are interpolated for shading; without
/// them the mesh is faceted, or `smooth`. Without texture coordinates, uv are the barycentric coordinates of the second
/// and third corner. toWorld may mirror: normals go through its inverse transpose, and the side follows them.
///
/// Faces with `usemtl NAME` get the `<bsdf name="NAME">` of the mesh. Others get its `<bsdf>` without a name of a material;
/// in a mesh that has neither this nor an emitter, what the file's MTL says (see docs/scene-language.md).
///
///     filename      string      the OBJ file, relative to the scene file   (required)
///     toWorld       transform   from the file's coordinates to the world   (default: the identity)
///     smooth        boolean     if the file has no normals: those of the faces, averaged at each vertex with the angles
///                               that the faces have there   (default false)
///     faceNormals   boolean     faceted, and the normals of the file do not count   (default false)
///     flipV         boolean     texture coordinate v becomes 1 - v   (default false)
///     flipNormals   boolean     turn the front side to the back   (default false)
///     materials     boolean     whether the MTL files that `mtllib` names are read where they are needed   (default true)
///
///         <mesh type="obj">
///             <string name="filename" value="meshes/teapot.obj"/>
///             <transform name="toWorld"><translate value="0, 1, 0"/></transform>
///         </mesh>
class ObjMesh final : public TriangleMesh {
public:
    explicit ObjMesh(const Params& params) : TriangleMesh(params, read_obj)
    {
        if (!params.boolean("materials", true)) forget_material_files();
    }
};

template std::unique_ptr<Shape> build<ObjMesh>(const Params&);

} // namespace plumb
