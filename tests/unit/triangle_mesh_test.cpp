// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"

#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"
#include "support/temp_directory.h"

#include <vector>

namespace plumb {
class ObjMesh;
}

namespace plumb::test {
namespace {

// What a shape says it is made of.
struct Recorder final : AccelBuilder {
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
    void add_triangles(std::span<const Vec3f> p, std::span<const Triangle> t) override
    {
        positions.assign(p.begin(), p.end());
        triangles.assign(t.begin(), t.end());
    }
    void add_user(const Primitives&) override { FAIL("a mesh has triangles only"); }
};

class Meshes {
public:
    ParamsBuilder params(const std::string& text)
    {
        return ParamsBuilder("mesh", "obj").string("filename", directory_.write("mesh.obj", text).string());
    }
    std::unique_ptr<Shape> read(const std::string& text) { return params(text).build<ObjMesh, Shape>(); }
    std::unique_ptr<Shape> read(const std::string& text, const Transform& to_world)
    {
        return params(text).transform("toWorld", to_world).build<ObjMesh, Shape>();
    }

private:
    TempDirectory directory_;
};

const std::string one_triangle = "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n";
const Ray downwards{Vec3f(0.5f, 1.f, 3.f), Vec3f(0, 0, -1)};

} // namespace

TEST_CASE("a mesh hands its triangles on and knows its size", "[unit][shape]")
{
    Meshes meshes;
    const auto mesh = meshes.read("v 0 0 0\nv 2 0 0\nv 2 2 1\nv 0 2 1\nf 1 2 3 4\n");
    Recorder recorder;
    mesh->add_to(recorder);
    CHECK(recorder.positions.size() == 4);
    CHECK(recorder.triangles.size() == 2);
    CHECK(mesh->triangle_count() == 2);
    CHECK(mesh->area() == Approx(2.0 * std::sqrt(5.0)));
    CHECK(mesh->bounds().min == Vec3f(0, 0, 0));
    CHECK(mesh->bounds().max == Vec3f(2, 2, 1));
}

TEST_CASE("a mesh of two triangles that make a rectangle is sampled by solid angle", "[unit][shape]")
{
    Meshes meshes;
    const std::string corners = "v 1 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    // All orders of corners, and a mirrored second triangle, whose front the normals decide.
    const char* second[] = {"1/1 3/3 4/4", "3/3 4/4 1/1", "4/4 1/1 3/3"};
    for (const char* first : {"1/1 2/2 3/3", "2/2 3/3 1/1", "3/3 1/1 2/2"})
        for (const char* other : second) {
            const auto mesh = meshes.read(corners + "f " + first + "\nf " + other + "\n");
            CAPTURE(first, other);
            REQUIRE(mesh->has_solid_angle());
            TestRandom random(8);
            for (int i = 0; i < 50; ++i) {
                const Vec3f from(2.f + random.next_1d(), random.next_1d(), 0.1f + random.next_1d());
                const auto sample = mesh->sample_solid_angle(from, random.next_2d());
                REQUIRE(sample);
                CHECK(sample->pdf == *mesh->solid_angle_pdf(from));
                CHECK(sample->normal == Vec3f(0, 0, 1));
                const Vec2f uv((sample->position.x - 1.f) * 0.5f, sample->position.y);
                CHECK((sample->uv - uv).length() < 1e-6f);
                CHECK((uv.x >= 0.f && uv.x <= 1.f && uv.y >= 0.f && uv.y <= 1.f));
            }
        }
    const std::string normals = "vn 0 0 1\n";
    CHECK(meshes.read(corners + normals + "f 1//1 2//1 3//1\nf 1//1 4//1 3//1\n")->has_solid_angle());

    for (const char* faces :
         {"f 1 2 3\n", "f 1 2 3\nf 2 3 4\n", "f 1 2 3\nf 1 4 3\n", "f 1 2 3\nf 1 3 2\n"}) {
        const auto mesh = meshes.read(corners + faces);
        CAPTURE(faces);
        CHECK_FALSE(mesh->has_solid_angle());
        CHECK_FALSE(mesh->sample_solid_angle(Vec3f(2, 0.5f, 1), Vec2f(0.5f)));
        CHECK_FALSE(mesh->solid_angle_pdf(Vec3f(2, 0.5f, 1)));
    }
    // Not flat, a kite, a parallelogram.
    for (const char* fourth : {"v 0 1 0.1\n", "v -0.28 0.96 0\n", "v 0.1 1 0\n"})
        CHECK_FALSE(meshes.read(std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\n") + fourth + "f 1 2 3 4\n")
                        ->has_solid_angle());
}

TEST_CASE("without normals and uvs a mesh is faceted and uv are barycentric", "[unit][shape]")
{
    Meshes meshes;
    const SurfacePoint at = meshes.read(one_triangle)->surface_at(downwards, 0);
    CHECK(at.position == Vec3f(0.5f, 1.f, 0.f));
    CHECK(at.geometric_normal == Vec3f(0, 0, 1)); // counter-clockwise from here
    CHECK(at.shading.n == Vec3f(0, 0, 1));
    CHECK(at.uv == Vec2f(0.25f, 0.5f)); // of the second and third corner
    CHECK(at.clearance < 1e-30f);       // exactly in the plane z = 0
    CHECK(at.bsdf == nullptr);
    CHECK(at.emitter == nullptr);
}

TEST_CASE("normals and uvs of a mesh are interpolated", "[unit][shape]")
{
    Meshes meshes;
    const std::string normals = "vn 1 0 1\nvn 0 1 1\nvn -1 0 1\n";
    const std::string uvs = "vt 0 0\nvt 4 0\nvt 0 8\n";
    const auto mesh = meshes.read("v 0 0 0\nv 2 0 0\nv 0 2 0\n" + normals + uvs + "f 1/1/1 2/2/2 3/3/3\n");
    const SurfacePoint at = mesh->surface_at(downwards, 0);
    const float h = std::sqrt(0.5f);
    const Vec3f expected =
        normalize(Vec3f(h, 0, h) * 0.25f + Vec3f(0, h, h) * 0.25f + Vec3f(-h, 0, h) * 0.5f);
    CHECK(length(at.shading.n - expected) < 1e-6f);
    CHECK(at.geometric_normal == Vec3f(0, 0, 1));
    CHECK(at.uv == Vec2f(1.f, 4.f));
}

TEST_CASE("the front of a mesh is the side of its vertex normals", "[unit][shape]")
{
    Meshes meshes;
    const std::string upside_down = "v 0 0 0\nv 2 0 0\nv 0 2 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n";
    CHECK(meshes.read(upside_down)->surface_at(downwards, 0).geometric_normal == Vec3f(0, 0, -1));
    const auto sampled = meshes.read(upside_down);
    sampled->prepare_sampling();
    CHECK(sampled->sample_area(0.5, Vec2f(0.5f)).normal == Vec3f(0, 0, -1));

    // A mirror turns the winding round; given normals are mirrored with the mesh, and the front follows them.
    const std::string upright = "v 0 0 1\nv 2 0 1\nv 0 2 1\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    const Transform mirror = *Transform::scale(Vec3d(1, 1, -1));
    const auto mirrored = meshes.read(upright, mirror);
    CHECK(mirrored->surface_at(downwards, 0).position == Vec3f(0.5f, 1.f, -1.f));
    CHECK(mirrored->surface_at(downwards, 0).geometric_normal == Vec3f(0, 0, -1));
    CHECK(mirrored->surface_at(downwards, 0).shading.n == Vec3f(0, 0, -1));
    const Transform sideways = *Transform::scale(Vec3d(-1, 1, 1));
    const Ray from_left{Vec3f(-0.5f, 1.f, 3.f), Vec3f(0, 0, -1)};
    CHECK(meshes.read(upright, sideways)->surface_at(from_left, 0).geometric_normal == Vec3f(0, 0, 1));
    // Without normals there is only the winding.
    CHECK(meshes.read(one_triangle, sideways)->surface_at(from_left, 0).geometric_normal == Vec3f(0, 0, -1));
}

TEST_CASE("normals of a mesh go through the inverse transpose", "[unit][shape]")
{
    Meshes meshes;
    const std::string slope = "v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n";
    const auto mesh = meshes.read(slope, *Transform::scale(Vec3d(2, 1, 1)));
    const SurfacePoint at = mesh->surface_at({Vec3f(0.5f, 0.25f, 3), Vec3f(0, 0, -1)}, 0);
    CHECK(length(at.shading.n - normalize(Vec3f(1, 0, 2))) < 1e-6f);
    CHECK(length(at.geometric_normal - at.shading.n) < 1e-6f);
}

TEST_CASE("vertex normals that cancel give way to the geometric normal", "[unit][shape]")
{
    Meshes meshes;
    const auto mesh = meshes.read("v 0 0 0\nv 2 0 0\nv 0 2 0\nvn 1 0 0\nvn -1 0 0\nf 1//1 2//2 3//2\n");
    // Here the weights of the two opposite normals are equal.
    const SurfacePoint at = mesh->surface_at({Vec3f(0.5f, 0.5f, 3), Vec3f(0, 0, -1)}, 0);
    CHECK(at.shading.n == at.geometric_normal);
    CHECK(std::abs(at.geometric_normal.z) == 1.f);
}

TEST_CASE("points of a mesh lie within their clearance of the triangle's plane", "[unit][shape]")
{
    Meshes meshes;
    TestRandom random(3);
    for (const double scale : {1e-4, 1.0, 1e5})
        for (int i = 0; i < 50; ++i) {
            const Transform place = Transform::rotate(Vec3d(random.direction()), random.between(0, 360)) *
                                    *Transform::scale(Vec3d(scale)) *
                                    Transform::translate(Vec3d(random.direction()) * 3.0);
            const auto mesh = meshes.read(one_triangle, place);
            Recorder recorder;
            mesh->add_to(recorder);
            mesh->prepare_sampling();
            const Vec3d p0(recorder.positions[0]);
            const Vec3d normal =
                normalize(cross(Vec3d(recorder.positions[1]) - p0, Vec3d(recorder.positions[2]) - p0));
            const auto check = [&](const Vec3f& p, float clearance) {
                const double off = std::abs(dot(Vec3d(p) - p0, normal));
                CHECK(off <= static_cast<double>(clearance));
                CHECK(static_cast<double>(clearance) <= 1e-5 * scale);
            };
            const ShapeSample sample = mesh->sample_area(random.next_double(), random.next_2d());
            check(sample.position, sample.clearance);
            const Vec3f origin = sample.position + random.direction() * static_cast<float>(scale);
            const SurfacePoint at = mesh->surface_at({origin, sample.position - origin}, 0);
            check(at.position, at.clearance);
        }
}

TEST_CASE("points on a mesh are uniform over its area", "[unit][shape]")
{
    Meshes meshes;
    // Areas 2, 0 and 6.
    const auto mesh =
        meshes.read("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 4 0 0\nv 6 0 0\nv 4 0 6\nf 1 2 3\nf 1 2 2\nf 4 5 6\n");
    CHECK(mesh->area() == 8.f);
    mesh->prepare_sampling();
    TestRandom random;
    int on_first = 0;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
        const Vec2f u = random.next_2d();
        const ShapeSample sample = mesh->sample_area((i + 0.5) / count, u);
        CHECK(sample.pdf == 0.125f);
        if (sample.position.x <= 2.f) {
            ++on_first;
            CHECK(sample.normal == Vec3f(0, 0, 1));
            CHECK(sample.position.x + sample.position.y <= 2.00001f);
        } else {
            CHECK(sample.normal == Vec3f(0, -1, 0));
        }
    }
    CHECK(on_first == count / 4);
    CHECK(mesh->sample_area(0x1.fffffffffffffp-1, Vec2f(one_minus_epsilon)).position.x >= 4.f);
}

TEST_CASE("a mesh without area, out of range or missing is an error", "[unit][shape]")
{
    Meshes meshes;
    CHECK_THROWS_WITH(meshes.read("v 0 0 0\nv 1 0 0\nf 1 2 2\n"), ContainsSubstring("area"));
    const Transform tiny = *Transform::scale(Vec3d(1e-30));
    CHECK_THROWS_WITH(meshes.read(one_triangle, tiny), ContainsSubstring("area of 0"));
    const auto huge = meshes.params(one_triangle).transform("toWorld", *Transform::scale(Vec3d(1e39)));
    CHECK_THAT((huge.complaints<ObjMesh, Shape>().at(0)),
               ContainsSubstring("farther than a 32-bit float can represent"));
    const auto missing = ParamsBuilder("mesh", "obj").string("filename", "no/such.obj");
    CHECK_THAT((missing.complaints<ObjMesh, Shape>().at(0)), ContainsSubstring("no/such.obj"));
    CHECK((missing.complaints<ObjMesh, Shape>().size()) == 1);
    CHECK((ParamsBuilder("mesh", "obj").complaints<ObjMesh, Shape>().size()) == 1);
}

TEST_CASE("what the reader repaired becomes a warning of the mesh", "[unit][shape]")
{
    Meshes meshes;
    const std::string some_normals = "v 0 0 0\nv 2 0 0\nv 0 2 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1 2 3\n";
    const auto complaints = meshes.params(some_normals).complaints<ObjMesh, Shape>();
    REQUIRE(complaints.size() == 1);
    CHECK_THAT(complaints[0], ContainsSubstring("warning") && ContainsSubstring("normal"));
}

} // namespace plumb::test
