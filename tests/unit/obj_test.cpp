// SPDX-License-Identifier: MIT

#include "plumb/base/error.h"
#include "plumb/model/shape.h"
#include "plumb/shapes/mesh.h"
#include "shapes/obj/obj_number.h"
#include "shapes/obj/obj_polygon.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <fmt/format.h>

#include <cstdlib>

using namespace plumb;

namespace {

MeshData read_text(const std::string& text)
{
    const TempDirectory directory;
    const auto path = directory.write("mesh.obj", text);
    return read_obj(path);
}

// "line:column: message" of the error that reading gives, and the marked text in front.
std::string error_of(const std::string& text)
{
    try {
        read_text(text);
    } catch (const FileError& error) {
        const SourceLocation& at = error.location();
        const auto column = static_cast<std::size_t>(at.column - 1);
        return fmt::format("{}:{} [{}] {}", at.line, at.column,
                           at.line_text.substr(column, static_cast<std::size_t>(at.length)), error.what());
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

Vec3d triangle_normal(const MeshData& mesh, const MeshData::Triangle& t)
{
    const Vec3d a(mesh.positions[t[0]]);
    return cross(Vec3d(mesh.positions[t[1]]) - a, Vec3d(mesh.positions[t[2]]) - a);
}

// The areas of the triangles added up, and their vectors added up: equal in length if none is folded back.
double total_area(const MeshData& mesh)
{
    double sum = 0.0;
    for (const auto& t : mesh.triangles) sum += 0.5 * length(triangle_normal(mesh, t));
    return sum;
}

Vec3d area_vector(const MeshData& mesh)
{
    Vec3d sum(0.0);
    for (const auto& t : mesh.triangles) sum += triangle_normal(mesh, t) * 0.5;
    return sum;
}

std::string polygon_obj(const std::vector<Vec3f>& corners)
{
    std::string text;
    std::string face = "f";
    for (std::size_t i = 0; i < corners.size(); ++i) {
        text += fmt::format("v {} {} {}\n", corners[i].x, corners[i].y, corners[i].z);
        face += fmt::format(" {}", i + 1);
    }
    return text + face + "\n";
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

} // namespace

TEST_CASE("OBJ files with triangles, quads and every kind of index", "[unit][obj]")
{
    const std::string face =
        GENERATE(as<std::string>{}, "f 1 2 3\nf 1 3 4\n", "f 1 2 3 4\n", "f -4 -3 -2 -1\n", "f +1 -3 3 -1",
                 "  f\t1  2\t3 4 \t", "f 1 2 3 4 # a comment\n", "f 1 2 3 # one\n# two\n\nf 1 3 4 #\n");
    const MeshData mesh =
        read_text("# header\no thing\ng a b\nusemtl x\ns off\nmtllib none.mtl\n" + square + face);
    CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.normals.empty());
    CHECK(mesh.uvs.empty());
    CHECK(mesh.warning.empty());
}

TEST_CASE("statements of an OBJ file go on behind a backslash at the end of a line", "[unit][obj]")
{
    const std::string end = GENERATE(as<std::string>{}, "\n", "\r\n", "\r");
    const std::string text =
        GENERATE(as<std::string>{}, "f 1 2 \\|3 4", "f \\|1 2\\|3\\|4", "f\\|1 2 3 4", "f 1 2 3\\|\\| \\|4",
                 "\\|f 1 2 3 4", "f 1 2 3|f 1\\|3 4", "f 1\\|2 3|f 1 3 4 # end\\|g x", "f 1 2 3 4\\",
                 "# C:\\|f 1 2 3 4", "mtllib C:\\a\\b.mtl|f 1 2 3 4", "g a \\|f 1 2 3|f 1 2 3 4",
                 "l 1 2 \\|3 4|f 1 2 3 4", "f 1 2 3 4|\\|");
    std::string whole = "v 0 0\\|0|v 1 0 \\|\t0|v\\|1 1 0|v 0 1 0 \\|# end|" + text;
    for (std::size_t i = whole.find('|'); i != whole.npos; i = whole.find('|')) whole.replace(i, 1, end);
    CAPTURE(whole);
    const MeshData mesh = read_text(whole);
    CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.warning.empty());
}

TEST_CASE("corners of an OBJ file may leave out what follows their slashes", "[unit][obj]")
{
    const std::string before = square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    const MeshData plain = read_text(before + "f 1 2 3\nf 1 3 4\n");
    for (const std::string face :
         {"f 1// 2// 3//\nf 1// 3// 4//\n", "f 1/ 2/ 3/\nf 1/ 3/ 4/\n", "f 1 2// 3/\nf -4// -2 -1/\n",
          "f 1 2 3\nf 1// 3 4\n", "f 1// 2 3 # a\nf 1 3\\\n 4//\n"}) {
        CAPTURE(face);
        const MeshData mesh = read_text(before + face);
        CHECK(mesh.positions == plain.positions);
        CHECK(mesh.triangles == plain.triangles);
        CHECK(mesh.uvs.empty());
    }
    const MeshData textured = read_text(before + "f 1/1/ 2/2/ 3/3/\nf -4/-4/ 3/3 4/4/\n");
    CHECK(textured.triangles == plain.triangles);
    CHECK(textured.uvs == std::vector<Vec2f>{{0, 0}, {1, 0}, {1, 1}, {0, 1}});
}

TEST_CASE("the faces of an OBJ file have the material that the last usemtl names", "[unit][obj]")
{
    using Names = std::vector<std::string>;
    using Numbers = std::vector<std::uint32_t>;
    constexpr std::uint32_t none = FaceMaterials::none;
    const auto check = [](const std::string& text, const Names& names, const Numbers& of_primitive) {
        CAPTURE(text);
        const FaceMaterials materials = read_text(square + text).materials;
        CHECK(materials.names == names);
        CHECK(materials.of_primitive == of_primitive);
    };
    check("f 1 2 3\nf 1 3 4\n", {}, {});
    check("usemtl a\nf 1 2 3\nusemtl a\nf 1 3 4\n", {"a"}, {});
    check("usemtl a\nusemtl b\nf 1 2 3\nusemtl c\n", {"b"}, {}); // no face has a or c
    check("f 1 2 3\nusemtl a\nf 1 3 4\n", {"a"}, {none, 0});
    check("# usemtl a\nusemtlx b\nf 1 2 3\nusemtl a\nf 1 3 4\n", {"a"}, {none, 0});
    check("usemtl a\nf 1 2 3\n usemtl\tb c \r\nf 1 3 4\nusemtl a\nf 1 2 4\n", {"a", "b c"}, {0, 1, 0});
    // A quad is two triangles; triangles without area have none.
    check("usemtl a\nf 1 2 3 4\nusemtl b\nf 1 1 2\nf 1 2 3\n", {"a", "b"}, {0, 0, 1});
    CHECK(read_text("mtllib a b.mtl\nmtllib c.mtl # d\n" + square + "f 1 2 3\n").materials.libraries ==
          Names{"a b.mtl", "c.mtl # d"});
}

TEST_CASE("OBJ files with other line ends, with a byte order mark and without a last line end", "[unit][obj]")
{
    const std::string end = GENERATE(as<std::string>{}, "\n", "\r\n", "\r");
    const bool last = GENERATE(true, false);
    const MeshData mesh = read_text("\xef\xbb\xbfv 0 0 0" + end + "v 1 0 0" + end + end + "v 0 1 .5" + end +
                                    "vn 0 0 2" + end + "f -3//-1 -2//-1 -1//-1" + end + "v 5 5 5" + end +
                                    "f -4//1 -2//1 -1//1" + (last ? end : ""));
    CHECK(mesh.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5f}, {5, 5, 5}});
    CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.normals == std::vector<Vec3f>(4, Vec3f(0, 0, 1)));
}

TEST_CASE("vertices of an OBJ file are shared where the triple of indices is equal", "[unit][obj]")
{
    const MeshData mesh =
        read_text(square + "vt 0 0\nvt 1\nvt 1 1 0\nvt 0.5 0.25\nvn 0 0 1\nvn 0 3 4\n"
                           "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/2\nf 1/1/2 3/3/1 4/4/2\n");
    CHECK(mesh.triangles == std::vector<MeshData::Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 2, 3}});
    REQUIRE(mesh.positions.size() == 5);
    CHECK(mesh.positions[4] == mesh.positions[0]);
    CHECK(mesh.uvs == std::vector<Vec2f>{{0, 0}, {1, 0}, {1, 1}, {0.5f, 0.25f}, {0, 0}});
    CHECK(mesh.normals[0] == Vec3f(0, 0, 1));
    CHECK(length(mesh.normals[4] - Vec3f(0.f, 0.6f, 0.8f)) < 1e-7f);
    CHECK(mesh.warning.empty());
}

TEST_CASE("vertices that no triangle of an OBJ file uses are dropped", "[unit][obj]")
{
    const MeshData plain = read_text("v 9e17 0 0\n" + square + "v 7 7 7\nf 2 3 4\n");
    CHECK(plain.positions == std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    CHECK(plain.triangles == std::vector<MeshData::Triangle>{{0, 1, 2}});
    const MeshData with_normals = read_text("v 9 9 9\n" + square + "vn 0 0 1\nf 2//1 3//1 4//1\n");
    CHECK(with_normals.positions.size() == 3);
}

TEST_CASE("numbers of an OBJ file become the nearest float", "[unit][obj]")
{
    const std::string text = GENERATE(
        as<std::string>{}, "0.1", "+.5", "-3.", "1e-3", "-2.5E+10", "3.4028234e10", "0.123456789012345678",
        "16777217", "1.00000017881393432617187499", "1e-46", "-1e-400", "9.9999e17", "0.000000000000000001");
    const MeshData mesh = read_text("v " + text + " 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
    const float expected =
        std::strtof(text.c_str(), nullptr); // rounds correctly; reads "+.5" and "1e-400" too
    CHECK(mesh.positions[0].x == expected);
}

TEST_CASE("polygons of an OBJ file that are not convex are cut right", "[unit][obj]")
{
    // Each planar and simple, with its area. The same in three planes, from both sides, from every first corner.
    struct Shape {
        std::vector<Vec2f> corners;
        double area;
    };
    const auto shape =
        GENERATE(Shape{{{0, 0}, {4, 0}, {4, 3}, {1, 3}, {1, 1}, {0, 1}}, 10.0},                 // an L
                 Shape{{{0, 0}, {5, 0}, {5, 5}, {0, 5}, {0, 4}, {4, 4}, {4, 1}, {0, 1}}, 13.0}, // a U
                 Shape{{{0, 0}, {2, 1}, {4, 0}, {3, 2}, {4, 4}, {2, 3}, {0, 4}, {1, 2}}, 8.0},  // a star
                 Shape{{{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}, 3.0}, // collinear corners
                 Shape{{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}},
                       8.0},                                                    // a hole
                 Shape{{{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}, {-1, 1}}, 6.0}, // convex
                 Shape{{{0, 0}, {4, 0}, {1, 1}, {0, 4}}, 4.0});                 // a concave quad
    const int plane = GENERATE(0, 1, 2, 3);
    const bool reversed = GENERATE(false, true);
    for (std::size_t first = 0; first < shape.corners.size(); ++first) {
        std::vector<Vec3f> corners;
        for (std::size_t i = 0; i < shape.corners.size(); ++i) {
            const Vec2f p = shape.corners[(first + i) % shape.corners.size()];
            corners.push_back(plane == 0   ? Vec3f(p.x, p.y, 7.f)
                              : plane == 1 ? Vec3f(7.f, p.x, p.y)
                              : plane == 2 ? Vec3f(p.y, 7.f, p.x)
                                           : Vec3f(p.x, p.y, p.x + 2.f * p.y));
        }
        if (reversed) std::reverse(corners.begin(), corners.end());
        const MeshData mesh = read_text(polygon_obj(corners));
        const double slope = plane == 3 ? std::sqrt(6.0) : 1.0; // of the plane z = x + 2 y
        CAPTURE(plane, reversed, first);
        CHECK(total_area(mesh) == Approx(shape.area * slope));
        CHECK(length(area_vector(mesh)) == Approx(shape.area * slope)); // nothing folded back, nothing twice
        CHECK(dot(area_vector(mesh), newell_normal(corners)) > 0.0);
    }
}

TEST_CASE("a large polygon of an OBJ file that is not convex is cut right and quickly", "[unit][obj]")
{
    std::vector<Vec3f> corners; // a gear
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * pi_d * i / count;
        const double radius = i % 2 == 0 ? 1.0 : 1.1;
        corners.emplace_back(static_cast<float>(radius * std::cos(angle)),
                             static_cast<float>(radius * std::sin(angle)), 0.f);
    }
    const MeshData mesh = read_text(polygon_obj(corners));
    CHECK(mesh.triangles.size() == count - 2);
    CHECK(total_area(mesh) == Approx(0.5 * length(newell_normal(corners))).epsilon(1e-5));
    CHECK(length(area_vector(mesh)) == Approx(total_area(mesh)).epsilon(1e-6));
}

TEST_CASE("triangles without area are left out of an OBJ file with a warning", "[unit][obj]")
{
    const MeshData one = read_text(square + "f 1 2 3\nf 1 1 2\n");
    CHECK(one.triangles.size() == 1);
    CHECK(one.warning == "1 triangle has no area and was discarded");
    const MeshData two = read_text(square + "v 2 0 0\nf 1 2 3\nf 1 2 5\nf 3 3 3 3\n");
    CHECK(two.triangles.size() == 1);
    CHECK(two.warning == "3 triangles have no area and were discarded");
    CHECK_THAT(error_of(square + "f 1 1 2\n"), ContainsSubstring("no face has an area"));
    // a sliver has an area
    CHECK(read_text("v 0 0 0\nv 1e-15 0 0\nv 0 1e-15 0\nf 1 2 3\n").triangles.size() == 1);
}

TEST_CASE("corners of an OBJ file without a normal get their face's", "[unit][obj]")
{
    const std::string faces = GENERATE(as<std::string>{}, "f 1//1 2//1 3//1\nf 4 2 3\n", // none
                                       "f 1//1 2//1 3//1\nf 4//2 2//2 3//2\n");          // of length zero
    const MeshData mesh = read_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nvn 0 0 -3\nvn 0 0 0\n" + faces);
    REQUIRE(mesh.triangles.size() == 2);
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    for (const std::uint32_t vertex : mesh.triangles[0]) CHECK(mesh.normals[vertex] == Vec3f(0, 0, -1));
    const Vec3d expected = normalize(triangle_normal(mesh, mesh.triangles[1]));
    for (const std::uint32_t vertex : mesh.triangles[1])
        CHECK(length(Vec3d(mesh.normals[vertex]) - expected) < 1e-6);
    CHECK(mesh.warning ==
          "1 of 2 faces have corners without a normal, or with one of length zero, where the face's "
          "own normal is used");
}

TEST_CASE("texture coordinates of an OBJ file are all used or all left out", "[unit][obj]")
{
    const MeshData mesh = read_text(square + "vt 0 0\nf 1/1 2/1 3/1\nf 1 3 4\n");
    CHECK(mesh.uvs.empty());
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.warning == "texture coordinates are ignored, because some face corners have none");
}

TEST_CASE("every mistake in an OBJ file is an error with its place", "[unit][obj]")
{
    const std::string good = square + "vt 0 0\nvn 0 0 1\n";
    const auto [text, expected] = GENERATE_COPY(table<std::string, std::string>({
        {"v 0 abc 0\n" + good, "1:5 [abc] 'abc' is not a number; a vertex is written v x y z"},
        {"v 0 0 nan\n" + good, "1:7 [nan] numbers must be finite, not 'nan'"},
        {"v 0 -inf 0\n" + good, "1:5 [-inf] numbers must be finite, not '-inf'"},
        {"v 0 1e39 0\n" + good, "1:5 [1e39] numbers must lie between -1e18 and 1e18, not '1e39'"},
        {"v 0 -1e400 0\n" + good, "1:5 [-1e400] numbers must lie between -1e18 and 1e18, not '-1e400'"},
        {"v 0 2e18 0\n" + good, "1:5 [2e18] numbers must lie between -1e18 and 1e18, not '2e18'"},
        {"v 0 1.5.2 0\n" + good, "1:5 [1.5.2] '1.5.2' is not a number; a vertex is written v x y z"},
        {"v 0 0x10 0\n" + good, "1:5 [0x10] '0x10' is not a number; a vertex is written v x y z"},
        {"v 0 1,5 0\n" + good, "1:5 [1,5] '1,5' is not a number; a vertex is written v x y z"},
        {"v 0 +-1 0\n" + good, "1:5 [+-1] '+-1' is not a number; a vertex is written v x y z"},
        {"v 0 0\n" + good, "1:1 [v] a vertex needs 3 numbers, not 2: v x y z"},
        {"v\n" + good, "1:1 [v] a vertex needs 3 numbers, not 0: v x y z"},
        {"v 0 0 \\\nx\n" + good, "2:1 [x] 'x' is not a number; a vertex is written v x y z"},
        {"v 0 \\\r\n 0\\\r\n\\\r\nx\r\n" + good, "4:1 [x] 'x' is not a number; a vertex is written v x y z"},
        {"v 0 0\\\n\n" + good, "1:1 [v] a vertex needs 3 numbers, not 2: v x y z"},
        {"v 0 0 \\ \n0\n" + good, "1:7 [\\] '\\' is not a number; a vertex is written v x y z"},
        {"v 0 0 0 # \\\nv 0 x 0\n" + good, "2:5 [x] 'x' is not a number; a vertex is written v x y z"},
        {"# C:\\a\\\nv 0 x 0\n" + good, "2:5 [x] 'x' is not a number; a vertex is written v x y z"},
        {"v 0 0 0\rv 0 0 0\r v 0 y 0\r" + good, "3:6 [y] 'y' is not a number; a vertex is written v x y z"},
        {"vn 1 0\n" + good, "1:1 [vn] a normal needs 3 numbers, not 2: vn x y z"},
        {"vt\n" + good, "1:1 [vt] a texture coordinate needs 1 number, not 0: vt u v"},
        {"vt 0 x\n" + good, "1:6 [x] 'x' is not a number; a texture coordinate is written vt u v"},
        {good + "f 0 1 2\n", "7:3 [0] indices count from 1 (or backwards from -1), not from 0"},
        {good + "f 1 2 5\n", "7:7 [5] vertex index 5 is out of range: the file has 4 vertices"},
        {good + "f 1 2 99999999999\n",
         "7:7 [99999999999] vertex index 99999999999 is out of range: the file has 4 "
         "vertices"},
        {good + "f 1 2 -5\n", "7:7 [-5] vertex index -5 is out of range: only 4 vertices so far"},
        {good + "f 1/1 2/2 3/1\n",
         "7:9 [2] texture coordinate index 2 is out of range: the file has 1 texture "
         "coordinate"},
        {good + "f 1//1 2//1 3//7\n", "7:16 [7] normal index 7 is out of range: the file has 1 normal"},
        {square + "f 1//1 2//1 3//1\n", "5:6 [1] normal index 1 is out of range: the file has no normals"},
        {good + "f 1/1/1 2/1/-2 3\n", "7:13 [-2] normal index -2 is out of range: only 1 normal so far"},
        {good + "f 1 2\n", "7:1 [f 1 2] a face needs at least 3 corners, not 2"},
        {good + "f\n", "7:1 [f] a face needs at least 3 corners, not 0"},
        {good + "f 1 2 3x\n", "7:7 [3x] '3x' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1/1/// 2 3\n",
         "7:3 [1/1///] '1/1///' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1/// 2 3\n",
         "7:3 [1///] '1///' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1/1/1/ 2 3\n",
         "7:3 [1/1/1/] '1/1/1/' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1//1/ 2 3\n",
         "7:3 [1//1/] '1//1/' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f /1 2 3\n", "7:3 [/1] '/1' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1/1/1/1 2 3\n",
         "7:3 [1/1/1/1] '1/1/1/1' is not a face corner; those are written p, p/t, p//n or "
         "p/t/n"},
        {good + "f 1 2 3#\n", "7:7 [3#] '3#' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1 2 1.5\n",
         "7:7 [1.5] '1.5' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1 2 \\\n3x\n",
         "8:1 [3x] '3x' is not a face corner; those are written p, p/t, p//n or p/t/n"},
        {good + "f 1\\\n 2\\\n", "7:1 [f 1\\] a face needs at least 3 corners, not 2"},
        {good + "f 1 2 3\nf 1\\\n2 5\n", "9:3 [5] vertex index 5 is out of range: the file has 4 vertices"},
        {good + "f 1 2 3\n\n f 1 a 3\n",
         "9:6 [a] 'a' is not a face corner; those are written p, p/t, p//n or p/t/n"},
    }));
    CHECK(error_of(text) == expected);
}

TEST_CASE("OBJ files that cannot be read are errors that name the file", "[unit][obj]")
{
    const TempDirectory directory;
    CHECK_THROWS_WITH(read_obj(directory.path() / "none.obj"), ContainsSubstring("none.obj': no such file"));
    CHECK_THROWS_WITH(read_obj(directory.path()), ContainsSubstring("it is a directory"));
    CHECK_THAT(error_of(""), ContainsSubstring("the file is empty"));
    CHECK_THAT(error_of("\n"), ContainsSubstring("no faces"));
    CHECK_THAT(error_of(square), ContainsSubstring("no faces"));
    CHECK_THAT(error_of(std::string("\x7f"
                                    "ELF\0\0\1\2\3\n\0\0",
                                    12)),
               ContainsSubstring("not a text file"));
    // a tab or a control character from the file does not reach the terminal
    CHECK_THAT(error_of("v 0 \x1b[31m 0\n"), ContainsSubstring("'?[31m' is not a number"));
    CHECK_THAT(error_of("v 0 " + std::string(1000, 'x') + " 0\n"),
               ContainsSubstring("xxx...' is not a number"));
}

TEST_CASE("a large OBJ file is read in parallel, with faces among the vertices", "[unit][obj]")
{
    // Strips of a helix, each of which names the vertices just before it; enough for several batches.
    constexpr int strips = 20000;
    std::string text;
    for (int i = 0; i < strips; ++i)
        text += fmt::format("v {} 0 0\nv {} 1 0\nv {} 0 1\nf -3 -2 -1\nf {} {} {}\n", i, i, i, 3 * i + 1,
                            3 * i + 3, 3 * i + 2);
    const MeshData mesh = read_text(text);
    REQUIRE(mesh.triangles.size() == 2 * strips);
    bool right = true;
    for (std::uint32_t i = 0; i < strips; ++i) {
        right = right && mesh.triangles[2 * i] == MeshData::Triangle{3 * i, 3 * i + 1, 3 * i + 2};
        right = right && mesh.triangles[2 * i + 1] == MeshData::Triangle{3 * i, 3 * i + 2, 3 * i + 1};
    }
    CHECK(right);
    // An error at its end still has its place.
    CHECK_THAT(error_of(text + "f 1 2 60001\n"), ContainsSubstring("100001:7 [60001]"));
    CHECK_THAT(error_of(text + "f 1 2 x\n"), ContainsSubstring("100001:7 [x]"));
}

namespace {

// A strip of triangles along x in several chunks: for each, three positions, normals, uvs and a face that counts back,
// with so many comments in front, which move the borders of the chunks.
struct Strip {
    static constexpr int triangles = 16000;
    int comments = 0;
    std::string end = "\n";
    std::vector<std::pair<int, std::string>> lines = {}; // instead of the face of triangle i

    std::string text() const
    {
        std::string text;
        for (int i = 0; i < comments; ++i) text += "#" + end;
        for (int i = 0; i < triangles; ++i) {
            text += fmt::format("v {0} 0 0{1}v {0} 1 0{1}v {0} 0 1{1}vt 0 {0}{1}vn 2 0 0{1}", i, end);
            std::string face = i % 2 == 0 ? "f -3/-1/-1 -2/-1/-1 -1/-1/-1"
                                          : fmt::format("f {0}/{3}/{3} {1}/{3}/{3} {2}/{3}/{3}", 3 * i + 1,
                                                        3 * i + 2, 3 * i + 3, i + 1);
            for (const auto& [triangle, line] : lines)
                if (triangle == i) face = line;
            text += face + end;
        }
        return text;
    }
};

} // namespace

TEST_CASE("where an OBJ file is cut into chunks does not matter", "[unit][obj]")
{
    const std::string end = GENERATE(as<std::string>{}, "\n", "\r\n");
    for (const int comments : {0, 1, 7, 20}) {
        const std::string text = Strip{comments, end}.text();
        REQUIRE(text.size() > (std::size_t{1} << 20));
        const MeshData mesh = read_text(text);
        REQUIRE(mesh.triangles.size() == Strip::triangles);
        REQUIRE(mesh.positions.size() == 3 * Strip::triangles);
        bool good = true;
        for (std::uint32_t i = 0; i < Strip::triangles; ++i) {
            const auto x = static_cast<float>(i);
            good = good && mesh.triangles[i] == MeshData::Triangle{3 * i, 3 * i + 1, 3 * i + 2};
            good = good && mesh.positions[3 * i + 1] == Vec3f(x, 1.f, 0.f) &&
                   mesh.uvs[3 * i] == Vec2f(0.f, x) && mesh.normals[3 * i + 2] == Vec3f(1.f, 0.f, 0.f);
        }
        CHECK(good);
        CHECK(mesh.warning.empty());
    }
}

TEST_CASE("statements of an OBJ file may go on across the border of two chunks", "[unit][obj]")
{
    // Everything about the border is one statement, in lines of two bytes and more, so that it hits every place in it.
    const std::string end = GENERATE(as<std::string>{}, "\n", "\r\n");
    for (int shift = 0; shift < 12; ++shift) {
        std::string text = square;
        while (text.size() < (std::size_t{1} << 20) - 100) text += "# a comment" + end;
        text += std::string(static_cast<std::size_t>(shift), ' ') + "v\\" + end;
        for (int i = 0; i < 40; ++i) text += " \\" + end;
        text += "7 \\" + end + "8" + end;
        const std::string lines = text;
        text += "f 1 2\\" + end + "3 5" + end;
        for (int i = 0; i < 200; ++i) text += "# a comment" + end;
        const MeshData mesh = read_text(text.replace(text.find("7 "), 2, "7 8 "));
        REQUIRE(mesh.positions.size() == 4);
        CHECK(mesh.positions[3] == Vec3f(7, 8, 8));
        const auto number = std::count(lines.begin(), lines.end(), '\n') + 2;
        CHECK(error_of(text + "f 1 2\\" + end + "3x" + end) ==
              fmt::format("{}:1 [3x] '3x' is not a face corner; those are "
                          "written p, p/t, p//n or p/t/n",
                          number + 202));
    }
}

TEST_CASE("materials of an OBJ file go on in the next chunk", "[unit][obj]")
{
    const auto materials = [](std::vector<std::pair<int, std::string>> lines) {
        return read_text(Strip{0, "\n", std::move(lines)}.text()).materials;
    };
    using Names = std::vector<std::string>;
    const std::string face = "\nf -3/-1/-1 -2/-1/-1 -1/-1/-1";
    const FaceMaterials same = materials({{0, "usemtl a" + face}, {15990, "usemtl a" + face}});
    CHECK(same.names == Names{"a"});
    CHECK(same.of_primitive.empty());
    const FaceMaterials other = materials({{0, "usemtl a" + face}, {15990, "usemtl b" + face}});
    CHECK(other.names == Names{"a", "b"});
    REQUIRE(other.of_primitive.size() > 2);
    CHECK(std::is_sorted(other.of_primitive.begin(), other.of_primitive.end()));
    CHECK(other.of_primitive.front() == 0);
    CHECK(other.of_primitive.back() == 1);
}

TEST_CASE("of an OBJ file's errors the first one is reported, whatever chunk it is in", "[unit][obj]")
{
    CHECK(error_of(Strip{0, "\n", {{15999, "f 1 2"}, {15000, "f 1 2 x"}, {15500, "f 0 1 2"}}}.text()) ==
          "90006:7 [x] 'x' is not a face corner; those are written p, p/t, p//n or p/t/n");
    CHECK(error_of(Strip{0, "\n", {{15999, "f 1 2 -48001"}}}.text()) ==
          "96000:7 [-48001] vertex index -48001 is out of range: only 48000 vertices so far");
    // Those that reach beyond the end are known when all is read: the largest, where it stands first.
    CHECK(error_of(
              Strip{0, "\n", {{3, "f 1 2 50000"}, {15990, "f 1 2 50001"}, {15995, "f 1 2 50001"}}}.text()) ==
          "95946:7 [50001] vertex index 50001 is out of range: the file has 48000 vertices");
}

TEST_CASE("missing normals of an OBJ file are those of the face in every chunk", "[unit][obj]")
{
    const MeshData mesh =
        read_text(Strip{0, "\n", {{10, "f -3/-1 -2/-1 -1/-1"}, {15998, "f -3/-1/-1 -2/-1/-1 -1/-1"}}}.text());
    CHECK(mesh.positions.size() == 3 * Strip::triangles);
    CHECK(std::all_of(mesh.normals.begin(), mesh.normals.end(),
                      [](const Vec3f& normal) { return normal == Vec3f(1.f, 0.f, 0.f); }));
    CHECK(mesh.warning ==
          "2 of 16000 faces have corners without a normal, or with one of length zero, where the "
          "face's own normal is used");
}
