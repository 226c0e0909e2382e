// SPDX-License-Identifier: MIT
#pragma once

// What every mesh promises that a file was read into.

#include "base/visible_text.h"
#include "fuzz/fuzz.h"
#include "plumb/shapes/mesh.h"

#include <cmath>

namespace plumb::fuzz {

inline void expect_mesh(const MeshData& mesh)
{
    const std::size_t count = mesh.positions.size();
    expect(!mesh.triangles.empty(), "a mesh without triangles");
    for (const MeshData::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) expect(corner < count, "a corner that is not there");
    expect(mesh.normals.empty() || mesh.normals.size() == count, "normals of some corners");
    expect(mesh.uvs.empty() || mesh.uvs.size() == count, "texture coordinates of some corners");
    for (const Vec3f& p : mesh.positions)
        expect(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
               "a position that is not finite");
    for (const Vec3f& n : mesh.normals)
        expect(std::abs(n.x * n.x + n.y * n.y + n.z * n.z - 1.f) < 1e-3f,
               "a normal that is not of unit length");
    for (const MeshAttribute& attribute : mesh.attributes) {
        const std::size_t values = attribute.channels * (attribute.per_face ? mesh.triangles.size() : count);
        expect(attribute.values.size() == values, "an attribute of some corners or triangles");
    }
    expect_printable(visible_text(mesh.warning));
}

} // namespace plumb::fuzz
