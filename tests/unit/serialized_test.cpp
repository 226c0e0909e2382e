// SPDX-License-Identifier: MIT

#include "plumb/base/error.h"
#include "plumb/model/shape.h"
#include "plumb/shapes/mesh.h"
#include "support/catch.h"
#include "support/mesh_files.h"
#include "support/params.h"
#include "support/temp_directory.h"

#include <limits>

namespace plumb {
class SerializedMesh;
}

using namespace plumb;
using namespace plumb::test;

namespace {

MeshData read_bytes_of(const std::string& bytes, std::uint32_t index = 0)
{
    const TempDirectory directory;
    return read_serialized(directory.write("m.serialized", bytes), index);
}

// The message behind the file's name.
std::string error_of(const std::string& bytes, std::uint32_t index = 0)
{
    try {
        read_bytes_of(bytes, index);
    } catch (const Error& error) {
        const std::string message = error.what();
        return message.substr(message.find("': ") + 3);
    }
    return "no error";
}

const std::vector<float> corner_numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::string one = serialized_mesh(0x1000, 3, corner_numbers, {0, 1, 2});

} // namespace

TEST_CASE("serialized meshes of both versions, with all that they may hold", "[unit][serialized]")
{
    std::vector<float> numbers = corner_numbers;
    for (const float x : {0.f, 0.f, 2.f, 0.f, 3.f, 4.f, 0.f, 0.f, 1.f}) numbers.push_back(x); // normals
    for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 1.f}) numbers.push_back(x);                // uv
    for (const float x : {1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f}) numbers.push_back(x); // colours
    for (const std::uint16_t version : {std::uint16_t{3}, std::uint16_t{4}}) {
        const std::string full = serialized_mesh(0x101b, 3, numbers, {0, 1, 2}, version);
        const std::string file =
            serialized_file({serialized_mesh(0x1000, 3, corner_numbers, {0, 2, 1}, version), full}, version);
        CHECK(read_bytes_of(file).triangles == std::vector<MeshData::Triangle>{{0, 2, 1}});
        const MeshData mesh = read_bytes_of(file, 1);
        CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(mesh.normals == std::vector<Vec3f>{{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}});
        CHECK(mesh.uvs == std::vector<Vec2f>{{0, 0}, {1, 0}, {0, 1}});
        CHECK(mesh.attributes.at(0).name == "vertex_color");
        CHECK(mesh.attributes.at(0).color(1) == Color(0.f, 1.f, 0.f));
        CHECK(error_of(file, 2) == "it has 2 meshes, so there is no shapeIndex 2");
    }
}

TEST_CASE("serialized meshes in double precision", "[unit][serialized]")
{
    std::string data = bytes_of<std::uint32_t>({0x2000}) + std::string("\0", 1) +
                       bytes_of<std::uint64_t>({3, 1}) + bytes_of<double>({0, 0, 0, 0.1, 0, 0, 0, 1, 0}) +
                       bytes_of<std::uint32_t>({0, 1, 2});
    CHECK(read_bytes_of(serialized_file({data})).positions[1] == Vec3f(0.1f, 0, 0));
}

TEST_CASE("errors of serialized files", "[unit][serialized]")
{
    const std::string file = serialized_file({one});
    const auto with = [&](std::size_t at, const std::string& bytes) {
        return std::string(file).replace(at, bytes.size(), bytes);
    };
    CHECK(error_of("") == "the file is empty");
    CHECK(error_of("ply\n") == "it is not a .serialized file: it must begin with the number 0x041C");
    CHECK(error_of(with(2, "\x05")) == "it has version 5 of the format; known are 3 and 4");
    CHECK(error_of(file.substr(0, 6)) == "the file ends too early");
    CHECK(error_of(with(file.size() - 4, bytes_of<std::uint32_t>({0}))) ==
          "its last number should be how many meshes it has, and is 0");
    CHECK(error_of(with(file.size() - 4, bytes_of<std::uint32_t>({4'000'000'000}))) ==
          "its last number should be how many meshes it has, and is 4000000000");
    CHECK(error_of(file, 1) == "it has 1 mesh, so there is no shapeIndex 1");
    CHECK(error_of(with(file.size() - 12, bytes_of<std::uint64_t>({1ull << 60}))) ==
          "mesh 0 should begin at byte 1152921504606846976, and the meshes end at byte " +
              std::to_string(file.size() - 12));
    CHECK(error_of(with(file.size() - 12, bytes_of<std::uint64_t>({1}))) ==
          "there is no mesh at byte 1, where mesh 0 should begin");
    CHECK(error_of(with(4, "zz")) == "its compressed data is damaged");

    const auto mesh_error = [](std::uint32_t flags, std::uint64_t vertices, const std::vector<float>& numbers,
                               const std::vector<std::uint32_t>& indices) {
        return error_of(serialized_file({serialized_mesh(flags, vertices, numbers, indices)}));
    };
    CHECK(mesh_error(0, 3, corner_numbers, {0, 1, 2}) ==
          "its flags 0x0 must say either single (0x1000) or double (0x2000) precision");
    CHECK(mesh_error(0x1000, 0, {}, {0, 1, 2}) == "it has no triangles");
    CHECK(mesh_error(0x1000, 3, corner_numbers, {}) == "it has no triangles");
    CHECK(mesh_error(0x1000, 1'000'000'000, corner_numbers, {0, 1, 2}) ==
          "it announces 1000000000 vertices and 1 triangles, for which it is too short");
    CHECK(mesh_error(0x1000, 18446744073709551615u, corner_numbers, {0, 1, 2}) ==
          "18446744073709551615 vertices and 1 triangles are more than 32-bit indices can count");
    CHECK(mesh_error(0x1000, 4, corner_numbers, {0, 1, 2}) == "its compressed data ends too early");
    CHECK(mesh_error(0x1000, 3, corner_numbers, {0, 1, 3}) ==
          "triangle 0 has corner 3; the mesh has 3 vertices, counted from 0");
    std::vector<float> numbers = corner_numbers;
    numbers[4] = std::numeric_limits<float>::quiet_NaN();
    CHECK(mesh_error(0x1000, 3, numbers, {0, 1, 2}) ==
          "the position of vertex 1 is nan; numbers must be finite and at most 1e+18");
    CHECK(mesh_error(0x1000, 3, {0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 1, 2}) == "no face has an area");
}

TEST_CASE("shapeIndex chooses the mesh", "[unit][serialized]")
{
    const TempDirectory directory;
    const auto path = directory.write(
        "m.serialized",
        serialized_file({one, serialized_mesh(0x1000, 3, {0, 0, 0, 4, 0, 0, 0, 4, 0}, {0, 1, 2})}));
    const auto params = [&](std::int64_t index) {
        return ParamsBuilder("shape", "serialized")
            .string("filename", path.string())
            .integer("shapeIndex", index);
    };
    CHECK(params(0).build<SerializedMesh, Shape>()->area() == 0.5f);
    CHECK(params(1).build<SerializedMesh, Shape>()->area() == 8.f);
    CHECK(params(-1).complaints<SerializedMesh, Shape>().size() == 1);
}
