// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "shapes/triangle_mesh.h"

namespace plumb {

/// A cube with its edges along the axes; toWorld may make any parallelepiped of it. The outside is the front side, which
/// emitters shine from.
///
/// uv run from 0 to 1 over each face, as in Mitsuba: with x y z from 0 to 1 through the cube, (u, v) are (y, 1 - z) where x
/// is largest, (y, z) where it is least; (1 - x, 1 - z) and (z, x) for y; (y, x) and (1 - y, x) for z.
///
///     center        point       the middle                                (default 0 0 0)
///     width         float       of an edge, greater than 0                (default 1)
///     toWorld       transform   from these coordinates to the world       (default: the identity)
///     flipNormals   boolean     make the inside the front side            (default false)
///
///         <shape type="cube">
///             <point name="center" value="0 0.5 0"/>
///             <float name="width" value="0.4"/>
///         </shape>
class Cube final : public TriangleMesh {
public:
    explicit Cube(const Params& params) : TriangleMesh(params, cube(params)) {}

private:
    static MeshData cube(const Params& params)
    {
        const Vec3f center = params.point("center", Vec3f(0.f));
        const float half = 0.5f * params.number("width", 1.f, Range::positive());
        // For each face: its normal, and the directions of u and v.
        static const Vec3f faces[6][3] = {
            {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
            {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},   {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
        };
        MeshData mesh;
        for (const auto& [normal, u, v] : faces) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const Vec2f& uv : {Vec2f(0, 0), Vec2f(1, 0), Vec2f(1, 1), Vec2f(0, 1)}) {
                mesh.positions.push_back(center +
                                         (normal + u * (2.f * uv.x - 1.f) + v * (2.f * uv.y - 1.f)) * half);
                mesh.normals.push_back(normal);
                mesh.uvs.push_back(uv);
            }
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangles.push_back({first, first + 2, first + 3});
        }
        return mesh;
    }
};

template std::unique_ptr<Shape> build<Cube>(const Params&);

} // namespace plumb
