// SPDX-License-Identifier: MIT

// OBJ meshes.

#include "base/visible_text.h"
#include "fuzz/fuzz.h"
#include "plumb/shapes/mesh.h"

#include <cmath>

using namespace plumb;
using namespace plumb::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto path = write_file("mesh.obj", text_of(data, size));
    allow_our_errors([&] {
        const MeshData mesh = read_obj(path);
        const std::size_t count = mesh.positions.size();
        expect(!mesh.triangles.empty(), "a mesh without triangles");
        for (const MeshData::Triangle& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle) expect(corner < count, "a corner that is not there");
        expect(mesh.normals.empty() || mesh.normals.size() == count, "normals of some corners");
        expect(mesh.uvs.empty() || mesh.uvs.size() == count, "texture coordinates of some corners");
        for (const Vec3f& p : mesh.positions)
            expect(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                   "a position that is not finite");
        expect_printable(visible_text(mesh.warning));
    });
    return 0;
}
