// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"

#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"

namespace plumb {
class Sphere;
}

namespace plumb::test {
namespace {

std::unique_ptr<Shape> sphere(const Vec3f& center, double radius, const Transform& to_world = {})
{
    return ParamsBuilder("shape", "sphere")
        .point("center", center)
        .number("radius", radius)
        .transform("toWorld", to_world)
        .build<Sphere, Shape>();
}

// Where a ray towards -direction meets the sphere.
Vec2f uv_in_direction(const Shape& shape, const Vec3f& center, const Vec3f& direction)
{
    return shape.surface_at(Ray{center + direction * 10.f, -direction}, 0).uv;
}

// The true solid angle's density for a sphere of radius 1 at this distance.
double true_pdf(double distance)
{
    const long double sine2 = 1.0L / (static_cast<long double>(distance) * distance);
    const long double one_minus_cos = sine2 / (1.0L + std::sqrt(1.0L - sine2));
    return static_cast<double>(1.0L / (2.0L * 3.14159265358979323846L * one_minus_cos));
}

} // namespace

TEST_CASE("a sphere is met from outside and from inside, normals outwards", "[unit][shape]")
{
    const auto ball = sphere(Vec3f(1, 2, 3), 2.0);
    const SurfacePoint outside = ball->surface_at(Ray{Vec3f(1, 2, 13), Vec3f(0, 0, -2)}, 0);
    CHECK(outside.position == Vec3f(1, 2, 5));
    CHECK(outside.geometric_normal == Vec3f(0, 0, 1));
    CHECK(outside.shading.n == Vec3f(0, 0, 1));
    const SurfacePoint inside = ball->surface_at(Ray{Vec3f(1, 2, 3), Vec3f(-1, 0, 0)}, 0);
    CHECK(inside.position == Vec3f(-1, 2, 3));
    CHECK(inside.geometric_normal == Vec3f(-1, 0, 0));
    CHECK(ball->area() == Approx(16.0 * pi_d));
    CHECK(ball->bounds().min == Vec3f(-1, 0, 1));
    CHECK(ball->bounds().max == Vec3f(3, 4, 5));
    CHECK(ball->triangle_count() == 0);
}

TEST_CASE("uv of a sphere turn with its toWorld", "[unit][shape]")
{
    const Vec3f center(3, 0, 0);
    const auto ball = sphere(center, 0.5);
    CHECK(uv_in_direction(*ball, center, Vec3f(0, 0, 1)).y == 0.f);
    CHECK(uv_in_direction(*ball, center, Vec3f(0, 0, -1)).y == 1.f);
    CHECK(uv_in_direction(*ball, center, Vec3f(1, 0, 0)) == Vec2f(1.f, 0.5f));
    CHECK(uv_in_direction(*ball, center, Vec3f(0, 1, 0)) == Vec2f(0.75f, 0.5f));
    CHECK(uv_in_direction(*ball, center, Vec3f(-1, 0, 0)) == Vec2f(0.5f, 0.5f));
    CHECK(uv_in_direction(*ball, center, Vec3f(0, -1, 0)) == Vec2f(0.25f, 0.5f));

    // A quarter turn about y takes z to x.
    const auto turned = sphere(Vec3f(0.f), 0.5, Transform::rotate(Vec3d(0, 1, 0), 90));
    CHECK(uv_in_direction(*turned, Vec3f(0.f), Vec3f(1, 0, 0)).y == 0.f);
    const auto mirrored = sphere(Vec3f(0.f), 0.5, *Transform::scale(Vec3d(1, -1, 1)));
    CHECK(uv_in_direction(*mirrored, Vec3f(0.f), Vec3f(0, -1, 0)) == Vec2f(0.75f, 0.5f));
    CHECK(mirrored->surface_at(Ray{Vec3f(0, 0, 3), Vec3f(0, 0, -1)}, 0).geometric_normal == Vec3f(0, 0, 1));
}

TEST_CASE("toWorld moves and scales a sphere, evenly or not at all", "[unit][shape]")
{
    const auto ball =
        sphere(Vec3f(1, 0, 0), 2.0, Transform::translate(Vec3d(0, 5, 0)) * *Transform::scale(Vec3d(3)));
    CHECK(ball->bounds().min == Vec3f(-3, -1, -6));
    CHECK(ball->bounds().max == Vec3f(9, 11, 6));
    const auto uneven =
        ParamsBuilder("shape", "sphere").transform("toWorld", *Transform::scale(Vec3d(1, 2, 1)));
    CHECK_THAT((uneven.complaints<Sphere, Shape>().at(0)), ContainsSubstring("use a mesh"));
    for (const double radius : {0.0, -1.0}) {
        const auto bad = ParamsBuilder("shape", "sphere").number("radius", radius);
        CHECK_THAT((bad.complaints<Sphere, Shape>().at(0)),
                   ContainsSubstring("radius must be greater than 0"));
    }
    const auto vast = ParamsBuilder("shape", "sphere").number("radius", 1e30);
    CHECK((vast.complaints<Sphere, Shape>().size()) == 1);
}

TEST_CASE("points of a sphere lie within their clearance of it", "[unit][shape]")
{
    TestRandom random;
    for (const double scale : {1e-4, 1.0, 1e5})
        for (int i = 0; i < 200; ++i) {
            const Vec3f center = random.direction() * static_cast<float>(scale * random.between(0.0, 100.0));
            const auto radius = static_cast<float>(scale);
            const auto ball = sphere(center, radius);
            const auto check = [&](const Vec3f& p, float clearance) {
                const double off = std::abs(length(Vec3d(p) - Vec3d(center)) - radius);
                CHECK(off <= static_cast<double>(clearance));
                CHECK(static_cast<double>(clearance) <= 1e-6 * (length(Vec3d(center)) + radius));
            };
            const Vec3f origin = center + random.direction() * static_cast<float>(3.0 * scale);
            const Vec3f aim = center + random.direction() * static_cast<float>(0.9 * scale);
            const SurfacePoint at = ball->surface_at(Ray{origin, aim - origin}, 0);
            check(at.position, at.clearance);
            const ShapeSample area = ball->sample_area(0.0, random.next_2d());
            check(area.position, area.clearance);
            CHECK(area.pdf == Approx(1.0 / (4.0 * pi_d * radius * radius)));
            const auto cone = ball->sample_solid_angle(origin, random.next_2d());
            REQUIRE(cone);
            check(cone->position, cone->clearance);
        }
}

TEST_CASE("the solid angle of a sphere, from far away to almost touching", "[unit][shape]")
{
    const auto ball = sphere(Vec3f(0.f), 1.0);
    CHECK(ball->has_solid_angle());
    TestRandom random;
    for (const float distance : {1.0000001192f, 1.00001f, 1.01f, 2.f, 100.f, 1e4f, 1e8f}) {
        CAPTURE(distance);
        const Vec3f from(0, 0, distance);
        REQUIRE(ball->solid_angle_pdf(from));
        CHECK(*ball->solid_angle_pdf(from) == Approx(true_pdf(distance)).epsilon(1e-6));
        const double sin_max = 1.0 / distance;
        for (int i = 0; i < 200; ++i) {
            const auto sample = ball->sample_solid_angle(from, random.next_2d());
            REQUIRE(sample);
            CHECK(sample->pdf == *ball->solid_angle_pdf(from));
            // Within the cone, and on the near side: the normal faces the receiver.
            const Vec3d towards = Vec3d(sample->position) - Vec3d(from);
            const double sine = length(cross(towards, Vec3d(0, 0, -1))) / length(towards);
            CHECK(sine <= sin_max * (1.0 + 1e-5));
            CHECK(dot(Vec3d(sample->normal), towards) <= 1e-6 * length(towards));
        }
        // The middle of the square is the nearest point.
        CHECK(ball->sample_solid_angle(from, Vec2f(0.5f))->position == Vec3f(0, 0, 1));
    }
}

TEST_CASE("from inside or on a sphere there is no cone", "[unit][shape]")
{
    const auto ball = sphere(Vec3f(0.f), 1.0);
    for (const Vec3f& from : {Vec3f(0.f), Vec3f(0.5f, 0, 0), Vec3f(0, 1, 0)}) {
        CHECK_FALSE(ball->sample_solid_angle(from, Vec2f(0.3f)));
        CHECK_FALSE(ball->solid_angle_pdf(from));
    }
}

} // namespace plumb::test
