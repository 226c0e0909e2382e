// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"

#include "base/float_mode.h"
#include "support/catch.h"
#include "support/lamp.h"
#include "support/params.h"
#include "support/random.h"
#include "support/statistics.h"

namespace plumb {
class Disk;
}

namespace plumb::test {
namespace {

ParamsBuilder disk()
{
    return ParamsBuilder("shape", "disk");
}

} // namespace

TEST_CASE("a disk without parameters is the unit disk facing +z", "[unit][shape]")
{
    const auto shape = disk().build<Disk, Shape>();
    CHECK(shape->area() == Approx(pi_d));
    CHECK(shape->bounds().min == Vec3f(-1, -1, 0));
    CHECK(shape->bounds().max == Vec3f(1, 1, 0));
    CHECK(shape->triangle_count() == 0);
    const SurfacePoint at = shape->surface_at(Ray{Vec3f(0, 0.25f, 2), Vec3f(0, 0, -2)}, 0);
    CHECK(at.position == Vec3f(0, 0.25f, 0));
    CHECK(at.geometric_normal == Vec3f(0, 0, 1));
    CHECK(at.uv == Vec2f(0.25f, 0.25f));
    CHECK(at.clearance < 1e-30f); // exactly in the plane z = 0
    const SurfacePoint left = shape->surface_at(Ray{Vec3f(-0.5f, 0, -2), Vec3f(0, 0, 1)}, 0);
    CHECK(left.uv == Vec2f(0.5f, 0.5f));
    CHECK(left.geometric_normal == Vec3f(0, 0, 1));
}

TEST_CASE("toWorld moves, stretches and mirrors a disk", "[unit][shape]")
{
    const auto ellipse =
        disk()
            .number("radius", 0.5)
            .transform("toWorld", Transform::translate(Vec3d(1, 2, 3)) * *Transform::scale(Vec3d(4, 2, -1)))
            .build<Disk, Shape>();
    CHECK(ellipse->area() == Approx(2.0 * pi_d));
    CHECK(ellipse->bounds().min == Vec3f(-1, 1, 3));
    CHECK(ellipse->bounds().max == Vec3f(3, 3, 3));
    const SurfacePoint at = ellipse->surface_at(Ray{Vec3f(2, 2, 9), Vec3f(0, 0, -1)}, 0);
    CHECK(at.position == Vec3f(2, 2, 3));
    CHECK(at.geometric_normal == Vec3f(0, 0, -1)); // the front follows the mirror
    CHECK(at.uv == Vec2f(0.5f, 0.f));
    CHECK(ellipse->tangents(at).dp_du == Vec3f(2, 0, 0));
}

TEST_CASE("points of a disk lie within their clearance of it, and in it", "[unit][shape]")
{
    TestRandom random;
    for (const double scale : {1e-4, 1.0, 1e5})
        for (int i = 0; i < 200; ++i) {
            const Vec3f center = random.direction() * static_cast<float>(scale * random.between(0.0, 100.0));
            const Vec3f normal = random.direction();
            const auto shape = disk()
                                   .point("center", center)
                                   .number("radius", scale)
                                   .vector("normal", normal)
                                   .build<Disk, Shape>();
            const ShapeSample sample = shape->sample_area(0.0, random.next_2d());
            const Vec3d offset = Vec3d(sample.position) - Vec3d(center);
            CHECK(std::abs(dot(offset, normalize(Vec3d(normal)))) <=
                  static_cast<double>(sample.clearance) + 1e-7 * scale); // the normal is a float
            CHECK(length(offset) <= scale);
            CHECK(static_cast<double>(sample.clearance) <= 1e-6 * (length(Vec3d(center)) + scale));
        }
}

TEST_CASE("rays that leave a disk do not find it again", "[statistical][self_intersection]")
{
    // As in statistical/self_intersection_test.cpp: any size, up to 1e4 times as far away, or in a plane through the origin,
    // stretched to ellipses; to both sides, down to angles of 1e-9 with the plane.
    const FlushDenormals mode;
    TestRandom random(21);
    std::uint64_t rays = 0, hits = 0, hits_without_offset = 0;
    for (int i = 0; i < 2000; ++i) {
        const double size = std::pow(10.0, random.between(-4, 5));
        const double offset = size * std::pow(10.0, random.between(-1, 4));
        Vec3f center = random.direction() * static_cast<float>(offset), normal = random.direction();
        if (i % 4 == 0) center -= normal * dot(center, normal);
        if (i % 4 == 1) normal = Vec3f(0, 0, 1);
        const Transform stretch = *Transform::scale(Vec3d(1.0, random.between(0.01, 1.0), -1.0));
        std::vector<SceneObject> objects;
        objects.push_back({disk()
                               .point("center", center)
                               .number("radius", size)
                               .vector("normal", normal)
                               .transform("toWorld", i % 3 == 0 ? stretch : Transform())
                               .build<Disk, Shape>(),
                           ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "disk"});
        const Scene scene(std::move(objects), {});
        for (int j = 0; j < 300; ++j) {
            const ShapeSample sample = scene.objects()[0].shape->sample_area(0.0, random.next_2d());
            SurfacePoint at;
            at.position = sample.position;
            at.geometric_normal = sample.normal;
            at.clearance = sample.clearance;
            const Vec3f from = sample.position + random.direction() * static_cast<float>(size);
            if (j % 2 == 0)
                if (const auto hit = scene.intersect({from, sample.position - from})) at = *hit;
            const Vec3d tangent = normalize(cross(Vec3d(sample.normal), Vec3d(random.direction())));
            const double slope = std::pow(10.0, random.between(-9, 1)) * (j % 3 == 0 ? -1.0 : 1.0);
            const Vec3f direction(tangent + Vec3d(sample.normal) * slope);
            if (dot(direction, sample.normal) == 0.f) continue;
            ++rays;
            hits += scene.occluded(at.spawn_ray(direction)) ? 1 : 0;
            at.clearance = 0.f;
            hits_without_offset += scene.occluded(at.spawn_ray(direction)) ? 1 : 0;
        }
    }
    CHECK(rays > 500'000);
    CHECK(hits == 0);
    CHECK(hits_without_offset > 100); // the test can fail
}

TEST_CASE("what is wrong with a disk", "[unit][shape]")
{
    CHECK_THAT((disk().number("radius", 0.0).complaints<Disk, Shape>().at(0)),
               ContainsSubstring("radius must be greater than 0"));
    CHECK((disk().vector("normal", Vec3f(0.f)).complaints<Disk, Shape>().at(0)) ==
          "error: normal must not be 0: it says where the front side is");
    CHECK_THAT((disk().number("radius", 1e30).complaints<Disk, Shape>().at(0)),
               ContainsSubstring("error: radius gives the disk area"));
}

TEST_CASE("light of a disk arrives in its closed form", "[statistical][emitter]")
{
    // On its axis: E = pi L r^2 / (r^2 + h^2).
    const Lamp lamp = white(disk()
                                .point("center", Vec3f(0, 2, 0))
                                .number("radius", 0.7)
                                .vector("normal", Vec3f(0, -1, 0))
                                .build<Disk, Shape>());
    SurfacePoint receiver;
    receiver.position = Vec3f(0.f);
    receiver.geometric_normal = Vec3f(0, 1, 0);
    const auto irradiance = [&](std::uint64_t samples, std::uint64_t seed) {
        TestRandom random(seed);
        MeanAndVariance result;
        for (std::uint64_t i = 0; i < samples; ++i) {
            const double u_select = random.next_double();
            const Vec2f u = random.next_2d();
            const auto s = lamp.emitter().sample({Vec3f(0.f)}, u_select, u, Measure::best);
            REQUIRE(s);
            CHECK_FALSE(lamp.scene().occluded(Scene::shadow_ray(receiver, *s)));
            CHECK(lamp.look(Vec3f(0.f), s->wi, Measure::best).pdf == Approx(s->pdf).epsilon(1e-3));
            result.add(static_cast<double>(s->radiance.r * s->wi.y / s->pdf));
        }
        return result;
    };
    check_mean("disk", pi_d * 2.0 * 0.49 / (0.49 + 4.0), irradiance, 2000, significance, 1, 1e-5);
}

} // namespace plumb::test
