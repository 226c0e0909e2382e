// SPDX-License-Identifier: MIT

#include "plumb/base/error.h"
#include "plumb/model/shape.h"
#include "plumb/shapes/mesh.h"
#include "support/catch.h"
#include "support/mesh_files.h"
#include "support/params.h"
#include "support/temp_directory.h"

#include <fmt/format.h>

namespace plumb {
class PlyMesh;
}

using namespace plumb;
using namespace plumb::test;

namespace {

MeshData read_text(const std::string& text)
{
    const TempDirectory directory;
    return read_ply(directory.write("mesh.ply", text));
}

// "line:column [marked text] message" of what reading throws; without a place, the message behind the file's name.
std::string error_of(const std::string& text)
{
    try {
        read_text(text);
    } catch (const FileError& error) {
        const SourceLocation& at = error.location();
        const auto column = static_cast<std::size_t>(at.column - at.line_text_column);
        return fmt::format("{}:{} [{}] {}", at.line, at.column,
                           at.line_text.substr(column, static_cast<std::size_t>(at.length)), error.what());
    } catch (const Error& error) {
        const std::string message = error.what();
        return message.substr(message.find("': ") + 3);
    }
    return "no error";
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string corners = "property list uchar int vertex_indices\n";

std::string header(const std::string& format, std::uint64_t vertices, const std::string& more_of_vertices,
                   std::uint64_t faces, const std::string& of_faces = corners)
{
    return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) + "\n" + xyz +
           more_of_vertices + "element face " + std::to_string(faces) + "\n" + of_faces + "end_header\n";
}

std::string ascii(const std::string& vertices_and_faces, std::uint64_t faces = 1)
{
    return header("ascii", 4, "", faces) + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + vertices_and_faces;
}

using Triangle = MeshData::Triangle;

} // namespace

TEST_CASE("a PLY mesh in ascii: positions, normals, texture coordinates under all names, polygons",
          "[unit][ply]")
{
    for (const auto& [u, v] :
         {std::pair("u", "v"), std::pair("s", "t"), std::pair("texture_u", "texture_v")}) {
        const std::string more = fmt::format("property float nx\nproperty double ny\nproperty float nz\n"
                                             "property float {}\nproperty float {}\n",
                                             u, v);
        const MeshData mesh = read_text("ply\r\nformat ascii 1.0\r\ncomment by hand\n" +
                                        header("ascii", 5, more, 2).substr(21) +
                                        "0 0 0 0 0 2 .1 .2\n1 0 0 0 0 1 +.3 .4\r\n\n1 1 0 0 0 1e-3 5e-1 .6\n"
                                        "  0\t1 0 0 0 1 .7 .8  \n.5 2 1e-60 0 0 1 .9 1\n3 0 1 2\n4 0 2 4 3");
        CHECK(mesh.warning.empty());
        REQUIRE(mesh.positions.size() == 5);
        CHECK(mesh.positions[4] == Vec3f(0.5f, 2.f, 0.f));
        REQUIRE(mesh.normals.size() == 5);
        for (const Vec3f& normal : mesh.normals) CHECK(normal == Vec3f(0, 0, 1));
        REQUIRE(mesh.uvs.size() == 5);
        CHECK(mesh.uvs[1] == Vec2f(0.3f, 0.4f));
        CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 4}, {0, 4, 3}});
    }
}

TEST_CASE("a PLY mesh in binary, of both byte orders and all types", "[unit][ply]")
{
    for (const bool big : {false, true}) {
        const std::string format = big ? "binary_big_endian" : "binary_little_endian";
        const auto f = [&](std::initializer_list<float> values) { return bytes_of(values, big); };
        const auto u8 = [&](std::initializer_list<std::uint8_t> values) { return bytes_of(values, big); };
        const auto i32 = [&](std::initializer_list<std::int32_t> values) { return bytes_of(values, big); };
        // Triangles only, which are read in parallel.
        const std::string vertices = f({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5f});
        const std::string two = u8({3}) + i32({0, 1, 2}) + u8({3}) + i32({2, 3, 0});
        MeshData mesh = read_text(header(format, 4, "", 2) + vertices + two);
        CHECK(mesh.positions[3] == Vec3f(0, 1, 0.5f));
        CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 3, 0}});

        // A quad behind a triangle, and properties of every type that are skipped or are attributes.
        const std::string more =
            "property double heat_0\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
        std::string data;
        for (int i = 0; i < 4; ++i) {
            const auto x = static_cast<float>(i == 1 || i == 2), y = static_cast<float>(i >= 2);
            data += f({x, y, 0}) + bytes_of<double>({0.5 * i}, big) +
                    u8({static_cast<std::uint8_t>(51 * i), 0, 255});
        }
        const std::string of_faces =
            "property list char ushort odd\nproperty short n\nproperty list uint uchar "
            "vertex_index\nproperty float id_0\n";
        const auto face = [&](float id, std::initializer_list<std::uint8_t> list) {
            return u8({2}) + bytes_of<std::uint16_t>({7, 8}, big) + bytes_of<std::int16_t>({-1}, big) +
                   bytes_of<std::uint32_t>({static_cast<std::uint32_t>(list.size())}, big) + u8(list) +
                   f({id});
        };
        mesh = read_text(header(format, 4, more, 3, of_faces) + data + face(5, {0, 1, 2}) +
                         face(6, {0, 1, 2, 3}) + face(7, {0, 1, 3}));
        CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 1, 3}});
        REQUIRE(mesh.attributes.size() == 3);
        CHECK(mesh.attributes[0].name == "vertex_color");
        CHECK(mesh.attributes[0].color(2) == Color(102.f * (1.f / 255.f), 0.f, 1.f));
        CHECK(mesh.attributes[1].name == "vertex_heat");
        CHECK(mesh.attributes[1].values == std::vector<float>{0.f, 0.5f, 1.f, 1.5f});
        CHECK(mesh.attributes[2].name == "face_id");
        CHECK(mesh.attributes[2].values == std::vector<float>{5.f, 6.f, 6.f, 7.f});
    }
}

TEST_CASE("attributes of a mesh at its points", "[unit][ply]")
{
    const TempDirectory directory;
    const auto file = directory.write(
        "mesh.ply", header("ascii", 4,
                           "property float c_r\nproperty float c_g\nproperty float c_b\nproperty float "
                           "two_0\nproperty float two_1\n",
                           1, corners + "property float w_0\n") +
                        "0 0 0 0 0 0 1 1\n2 0 0 1 0 0 1 1\n0 2 0 0 1 0 1 1\n0 0 9 0 0 9 1 1\n3 0 1 2 0.25\n");
    const auto mesh = ParamsBuilder("shape", "ply").string("filename", file.string()).build<PlyMesh, Shape>();
    CHECK(mesh->attribute_names() == std::vector<std::string>{"vertex_c", "face_w"});
    const SurfacePoint at = mesh->surface_at(Ray{Vec3f(0.5f, 1.f, 3.f), Vec3f(0, 0, -1)}, 0);
    const auto color = mesh->attribute("vertex_c", at);
    REQUIRE(color);
    CHECK(color->r == Approx(0.25));
    CHECK(color->g == Approx(0.5));
    CHECK(color->b == 0.f);
    CHECK(mesh->attribute("face_w", at) == Color(0.25f));
    CHECK_FALSE(mesh->attribute("face_c", at));
    CHECK_FALSE(mesh->attribute("", at));
}

TEST_CASE("odd PLY meshes are repaired, with a warning", "[unit][ply]")
{
    const MeshData flat = read_text(header("ascii", 5, "", 3, corners + "property float id_0\n") +
                                    "7 7 7\n0 0 0\n1 0 0\n0 1 0\n2 0 0\n3 1 2 3 4\n3 1 2 4 5\n3 2 3 3 6\n");
    CHECK(flat.triangles == std::vector<Triangle>{{0, 1, 2}});
    CHECK(flat.positions.size() == 3); // the other two belong to no triangle
    CHECK(flat.attributes.at(0).values == std::vector<float>{4.f});
    CHECK(flat.warning == "2 triangles have no area and were discarded");

    const MeshData normals =
        read_text(header("ascii", 3, "property float nx\nproperty float ny\nproperty float nz\n", 1) +
                  "0 0 0 0 0 0\n1 0 0 0 3 4\n0 1 0 0 0 1\n3 0 1 2\n");
    CHECK(normals.normals == std::vector<Vec3f>{{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}});
    CHECK(normals.warning == "1 of 3 normals have length zero, where those of the faces are used");

    CHECK(read_text(ascii("3 0 1 2\n3 0 1 2\n\n", 1)).warning == "1 line behind the last element is ignored");
}

TEST_CASE("errors of PLY headers name the place", "[unit][ply]")
{
    const std::string begin = "ply\nformat ascii 1.0\n";
    CHECK(error_of("") == "the file is empty");
    CHECK(error_of("plx\n") == "1:1 [plx] a PLY file starts with the line 'ply'");
    CHECK(error_of("ply\nformat ascii 1.0\n") ==
          "2:1 [format ascii 1.0] the header has no line 'end_header'");
    CHECK(error_of("ply\nend_header\n") == "2:1 [end_header] the header has no line 'format'");
    CHECK(error_of("ply\nformat text 1.0\n") == "2:8 [text] unknown format 'text'; known are ascii, "
                                                "binary_little_endian and binary_big_endian");
    CHECK(error_of("ply\nformat ascii 2.0\n") ==
          "2:1 [format ascii 2.0] must be 'format ascii 1.0' or the like");
    CHECK(error_of(begin + "elephant 3\n") == "3:1 [elephant] unknown word 'elephant' in the header");
    CHECK(error_of(begin + "element vertex -3\n") ==
          "3:16 [-3] '-3' is not a number of elements, a whole number from 0");
    CHECK(error_of(begin + "element vertex 99999999999999999999\n") ==
          "3:16 [99999999999999999999] '99999999999999999999' is not a number of elements, a whole number "
          "from 0");
    CHECK(error_of(begin + "property float x\n") ==
          "3:1 [property] a property must stand behind its element");
    CHECK(
        error_of(begin + "element vertex 3\nproperty real x\n") ==
        "4:10 [real] unknown type 'real'; known are char, uchar, short, ushort, int, uint, float and double");
    CHECK(error_of(begin + "element vertex 3\nproperty list float int x\n") ==
          "4:15 [float] the number of values in a list must be of an integer type");
    CHECK(error_of(begin + "element vertex 3\nproperty float x\nproperty float x\n") ==
          "5:16 [x] a second property 'x'");
    CHECK(error_of(begin + "element vertex 3\nproperty float x\nelement vertex 3\n") ==
          "5:9 [vertex] a second element 'vertex'");
    CHECK(error_of(begin + "element vertex 3\nend_header\n") ==
          "4:1 [end_header] element 'vertex' has no properties");
    CHECK(error_of(begin + "end_header\n") == "the file has no element 'vertex'");
    CHECK(error_of(begin + "element vertex 0\n" + xyz + "end_header\n") == "the file has no element 'face'");
    CHECK(error_of(header("ascii", 1, "", 1, "property list uchar int corners\n") + "0 0 0\n3 0 0 0\n") ==
          "the faces have no list 'vertex_indices' or 'vertex_index'");
    CHECK(error_of(begin + "element vertex 1\nproperty float x\nelement face 1\n" + corners +
                   "end_header\n0\n3 0 0 0\n") == "the vertices have no properties 'x', 'y' and 'z'");
}

TEST_CASE("PLY files that announce more than they have take no memory for it", "[unit][ply]")
{
    CHECK(error_of(header("ascii", 1'000'000'000, "", 1) + "0 0 0\n") ==
          "the header announces 1000000000 elements 'vertex', but the file has only 6 bytes for them");
    CHECK(error_of(header("binary_little_endian", 4'000'000'000, "", 1) + std::string(30, '\0')) ==
          "the header announces 4000000000 elements 'vertex', but the file has only 30 bytes for them");
    CHECK(error_of(header("binary_little_endian", 18446744073709551615u, "", 1) + std::string(30, '\0')) ==
          "18446744073709551615 vertices are more than 32-bit indices can count");
    CHECK(error_of(header("binary_little_endian", 2, "", 1'000'000'000) + std::string(30, '\0')) ==
          "the header announces 1000000000 elements 'face', but the file has only 30 bytes for them");
    CHECK(error_of(header("binary_little_endian", 1, "", 1, "property list uint int vertex_index\n") +
                   std::string(12, '\0') + std::string(4, '\xff')) == "the file ends in face 0 of 1");
    CHECK(error_of(header("ascii", 3, "", 2) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n") ==
          "the file ends after 1 of 2 elements 'face'");
    CHECK(error_of(header("ascii", 3, "", 0) + "0 0 0\n1 0 0\n0 1 0\n") == "the file has no faces");
    CHECK(error_of(header("ascii", 3, "", 1) + "0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n") == "no face has an area");
}

TEST_CASE("errors of PLY data name the line, or the vertex or face", "[unit][ply]")
{
    CHECK(error_of(ascii("3 0 1 4\n")) == "14:7 [4] there is no vertex 4; the file has 4, counted from 0");
    CHECK(error_of(ascii("3 0 1 -1\n")) == "14:7 [-1] '-1' is not a whole number from 0");
    CHECK(error_of(ascii("3 0 1\n")) == "14:6 [] the line ends before property 'vertex_indices' of 'face'");
    CHECK(error_of(ascii("2 0 1\n")) == "14:3 [0] a face needs at least 3 corners, not 2");
    CHECK(error_of(ascii("4000000000 0 1\n")) ==
          "14:15 [] the line ends before property 'vertex_indices' of 'face'");
    CHECK(error_of(ascii("3 0 1 2 9\n")) == "14:9 [9] more values than the properties of 'face' take");
    CHECK(error_of(header("ascii", 3, "", 1) + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n") ==
          "11:3 [nan] 'nan' is not a finite number");
    CHECK(error_of(header("ascii", 3, "", 1) + "0 0 0\n1 2e18 0\n0 1 0\n3 0 1 2\n") ==
          "11:3 [2e18] '2e18' is too large: numbers may be at most 1e+18");
    CHECK(error_of(header("ascii", 3, "", 1) + "0 0 0\n1 0,5 0\n0 1 0\n3 0 1 2\n") ==
          "11:3 [0,5] '0,5' is not a number");
    CHECK(error_of(header("ascii", 3, "", 1) + "0 0\n1 0 0\n0 1 0\n3 0 1 2\n") ==
          "10:4 [] the line ends before property 'z' of 'vertex'");

    const auto binary = [](const std::string& data, std::uint64_t faces = 1) {
        return error_of(header("binary_little_endian", 3, "", faces) + data);
    };
    const std::string good = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const auto nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(binary(bytes_of<float>({0, 0, 0, 1, nan, 0, 0, 1, 0}) + std::string(13, '\0')) ==
          "vertex 1: 'y' is not a finite number");
    CHECK(binary(bytes_of<float>({0, 0, 0, 1, 0, -1e30f, 0, 1, 0}) + std::string(13, '\0')) ==
          "vertex 1: 'z' is -1e+30, which is too large: numbers may be at most 1e+18");
    CHECK(binary(good + "\x03" + bytes_of<std::int32_t>({0, 1, 3})) ==
          "face 0 has corner 3; the file has 3 vertices, counted from 0");
    CHECK(binary(good + "\x03" + bytes_of<std::int32_t>({0, -1, 2})) ==
          "face 0 has corner -1; the file has 3 vertices, counted from 0");
    CHECK(binary(good + "\x02" + bytes_of<std::int32_t>({0, 1, 2})) ==
          "face 0 has 2 corners; it must have from 3 to 16777216");
    CHECK(binary(good + "\x04" + bytes_of<std::int32_t>({0, 1, 2})) == "the file ends in face 0 of 1");
    CHECK(binary(good + "\x03" + bytes_of<std::int32_t>({0, 1})) == "the file ends in face 0 of 1");
}

TEST_CASE("large PLY meshes are the same in ascii and binary", "[unit][ply]")
{
    // Several chunks of each kind.
    constexpr std::uint32_t n = 300;
    std::string text = header("ascii", n * n, "", 2 * (n - 1) * (n - 1));
    std::string binary = header("binary_little_endian", n * n, "", 2 * (n - 1) * (n - 1));
    for (std::uint32_t i = 0; i < n * n; ++i) {
        const auto x = static_cast<float>(i % n) / 7.f, y = static_cast<float>(i / n) / 3.f;
        text += fmt::format("{} {} {}\n", x, y, x * y);
        binary += bytes_of({x, y, x * y});
    }
    for (std::uint32_t y = 0; y + 1 < n; ++y)
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            const std::uint32_t a = y * n + x;
            text += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, a + 1, a + n + 1, a, a + n + 1, a + n);
            for (const auto& t : {Triangle{a, a + 1, a + n + 1}, Triangle{a, a + n + 1, a + n}})
                binary += "\x03" + bytes_of({t[0], t[1], t[2]});
        }
    const MeshData a = read_text(text), b = read_text(binary);
    CHECK(a.positions == b.positions);
    CHECK(a.triangles == b.triangles);
    CHECK(a.triangles.size() == 2 * (n - 1) * (n - 1));
    const std::size_t wrong = text.size() - 3; // in the last face
    text[wrong] = 'x';
    CHECK(error_of(text).find("is not a whole number from 0") != std::string::npos);
}
