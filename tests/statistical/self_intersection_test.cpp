// SPDX-License-Identifier: MIT

// A ray that leaves a surface does not find it again.
//
// Flat quads of two triangles, well-shaped, thin or aligned with an axis, from 1e-4 to 1e5 in size and up to 1e4
// times their size away from the origin, or in a plane through it: any hit is wrong. Rays start from sampled and from intersected points, also
// on edges, to both sides, in all directions and down to angles of 1e-9 with the plane. The factors of
// src/shapes/triangle.h were chosen with this test: in 3e7 rays there are wrong hits with factors of 1 and 1.5 and
// with 1.5 and 1, none with 2 and 1.5; the factors are 4 and 4.

#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"

#include "base/float_mode.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"
#include "support/temp_directory.h"

#include <fmt/format.h>

#include <string>

namespace plumb {
class Diffuse;
class Sphere;
class ObjMesh;
} // namespace plumb

namespace plumb::test {
namespace {

Scene scene_of(std::unique_ptr<Shape> shape)
{
    std::vector<SceneObject> objects;
    objects.push_back(
        {std::move(shape), ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "shape"});
    return Scene(std::move(objects), {});
}

struct Quad {
    Vec3f corners[4];
    double size;
};

Quad random_quad(TestRandom& random, int kind)
{
    const double size = std::pow(10.0, random.between(-4, 5));
    const double offset = size * (kind % 2 == 0 ? 1.0 : std::pow(10.0, random.between(0, 4)));
    Vec3d origin(random.between(-offset, offset), random.between(-offset, offset),
                 random.between(-offset, offset));
    Vec3d a(random.direction());
    Vec3d b = normalize(cross(a, Vec3d(random.direction())));
    double height = size * random.between(0.3, 1.0);
    if (kind == 6) origin = -b * (size * random.between(0.0, 1.0)); // in a plane through the origin
    if (kind < 2 || kind == 7) {                                    // along two axes
        const auto axis = static_cast<int>(random.between(0, 3));
        a = b = Vec3d(0.0);
        a[axis] = 1.0;
        b[(axis + 1) % 3] = 1.0;
        if (kind == 7) origin[(axis + 2) % 3] = 0.0; // in a coordinate plane
    } else if (kind < 4) {                           // thin
        height *= std::pow(10.0, random.between(-4, -1));
    }
    const double skew = kind < 2 || kind == 7 ? 0.0 : height * random.between(-0.3, 0.3);
    return {{Vec3f(origin), Vec3f(origin + a * size + b * skew), Vec3f(origin + a * size + b * height),
             Vec3f(origin + b * height)},
            size};
}

// Far from the origin, a thin quad may round to nothing.
bool has_area(const Quad& quad)
{
    const auto edge = [&](int to) { return Vec3d(quad.corners[to]) - Vec3d(quad.corners[0]); };
    return length(cross(edge(1), edge(2))) > 0.0 && length(cross(edge(2), edge(3))) > 0.0;
}

std::unique_ptr<Shape> mesh_of(const Quad& quad, const TempDirectory& directory)
{
    std::string text;
    for (const Vec3f& p : quad.corners) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    const auto file = directory.write("quad.obj", text + "f 1 2 3\nf 1 3 4\n");
    return ParamsBuilder("mesh", "obj").string("filename", file.string()).build<ObjMesh, Shape>();
}

// Any direction, or one that almost lies in the surface.
Vec3f leaving_direction(TestRandom& random, const Vec3f& normal)
{
    const Vec3f any = random.direction();
    if (random.next_1d() < 0.25f) return any;
    const Vec3d tangent = normalize(cross(Vec3d(normal), Vec3d(any)));
    const double slope = std::pow(10.0, random.between(-9, -0.5)) * (random.next_1d() < 0.5f ? -1.0 : 1.0);
    return Vec3f(tangent + Vec3d(normal) * slope);
}

SurfacePoint as_surface_point(const ShapeSample& sample)
{
    SurfacePoint at;
    at.position = sample.position;
    at.geometric_normal = sample.normal;
    at.clearance = sample.clearance;
    return at;
}

struct Count {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t hits_without_offset = 0;
};

// Rays that leave one flat shape.
void leave(const Scene& scene, double size, int rays, TestRandom& random, Count& count)
{
    Shape& shape = *scene.objects()[0].shape;
    shape.prepare_sampling();
    for (int i = 0; i < rays; ++i) {
        const double u_select = random.next_double();
        Vec2f u = random.next_2d();
        if (i % 5 == 0) u.y = i % 2 == 0 ? 0.f : 1.f; // on an edge
        const ShapeSample sample = shape.sample_area(u_select, u);
        SurfacePoint at = as_surface_point(sample);
        if (i % 3 == 0) {
            const Vec3f origin = sample.position + random.direction() * static_cast<float>(size);
            if (const auto hit = scene.intersect({origin, sample.position - origin})) at = *hit;
        }
        const Vec3f direction = leaving_direction(random, at.geometric_normal);
        if (dot(direction, at.geometric_normal) == 0.f) continue;
        ++count.rays;
        if (scene.occluded(at.spawn_ray(direction))) ++count.hits;
        at.clearance = 0.f;
        if (scene.occluded(at.spawn_ray(direction))) ++count.hits_without_offset;
    }
}

Count leave_quads(int quads, int rays)
{
    const FlushDenormals mode;
    const TempDirectory directory;
    TestRandom random(11);
    Count count;
    for (int i = 0; i < quads; ++i) {
        const Quad quad = random_quad(random, i % 8);
        if (has_area(quad)) leave(scene_of(mesh_of(quad, directory)), quad.size, rays, random, count);
    }
    return count;
}

} // namespace

TEST_CASE("rays that leave a triangle do not find it again", "[statistical][self_intersection]")
{
    const Count count = leave_quads(600, 300);
    CHECK(count.rays > 150000);
    CHECK(count.hits == 0);
    CHECK(count.hits_without_offset > 100); // the test can fail
}

TEST_CASE("many rays that leave a triangle do not find it again", "[statistical][self_intersection][slow]")
{
    const Count count = leave_quads(30000, 1000);
    CHECK(count.rays > 25000000);
    CHECK(count.hits == 0);
}

TEST_CASE("rays that leave a sphere outwards do not find it again", "[statistical][self_intersection]")
{
    const FlushDenormals mode;
    TestRandom random(12);
    Count count;
    for (int i = 0; i < 200; ++i) {
        const double radius = std::pow(10.0, random.between(-4, 5));
        const double offset = radius * std::pow(10.0, random.between(-1, 4));
        const Vec3f center = random.direction() * static_cast<float>(offset);
        const Scene scene = scene_of(ParamsBuilder("shape", "sphere")
                                         .point("center", center)
                                         .number("radius", radius)
                                         .build<Sphere, Shape>());
        const Shape& shape = *scene.objects()[0].shape;
        for (int j = 0; j < 500; ++j) {
            const SurfacePoint at = as_surface_point(shape.sample_area(0.0, random.next_2d()));
            const Vec3f direction = leaving_direction(random, at.geometric_normal);
            const float cosine = dot(direction, at.geometric_normal);
            if (cosine == 0.f) continue;
            const auto hit = scene.intersect(at.spawn_ray(direction));
            ++count.rays;
            if (cosine > 0.f && hit) ++count.hits;
            // Inwards, the other side is met at the end of the chord.
            if (cosine < -0.1f) {
                REQUIRE(hit);
                const double chord = 2.0 * radius * static_cast<double>(-cosine / length(direction));
                CHECK(std::abs(length(Vec3d(hit->position) - Vec3d(at.position)) - chord) <= 0.03 * radius);
            }
        }
    }
    CHECK(count.rays > 90000);
    CHECK(count.hits == 0);
}

} // namespace plumb::test
