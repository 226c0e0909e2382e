// SPDX-License-Identifier: MIT

#include "plumb/math/ray.h"

#include "plumb/model/surface.h"
#include "support/catch.h"
#include "support/random.h"

using namespace plumb;
using plumb::test::TestRandom;

TEST_CASE("points along a ray count multiples of its direction", "[unit][ray]")
{
    const Ray ray{Vec3f(1, 2, 3), Vec3f(0, 0, 2)};
    CHECK(ray.at(1.5f) == Vec3f(1, 2, 6));
    CHECK(ray.t_min == 0.f);
    CHECK(ray.t_max == infinity);
}

TEST_CASE("the next float is the next float", "[unit][ray]")
{
    for (const float x : {1.f, -1.f, 0.1f, -3e30f, 1e-30f, 16777216.f}) {
        CHECK(next_float(x, true) == std::nextafter(x, infinity));
        CHECK(next_float(x, false) == std::nextafter(x, -infinity));
    }
    // Around 0 it skips the denormal numbers, which flush-to-zero would undo.
    CHECK(next_float(0.f, true) == std::numeric_limits<float>::min());
    CHECK(next_float(0.f, false) == -std::numeric_limits<float>::min());
}

TEST_CASE("an offset origin leaves the error box on the side of the direction", "[unit][ray]")
{
    TestRandom random;
    for (int i = 0; i < 1000; ++i) {
        const Vec3f normal = random.direction();
        const Vec3f towards = random.direction();
        const Vec3f p = random.direction() * static_cast<float>(random.between(0.0, 1e4));
        const Vec3f error = abs(p) * 1e-6f;
        const float distance = clearance(error, abs(p), normal);
        const Vec3d moved = Vec3d(offset_origin(p, distance, normal, towards)) - Vec3d(p);
        const double side = dot(towards, normal) < 0.f ? -1.0 : 1.0;
        // The corner of the box that lies furthest out on that side.
        const double corner = dot(Vec3d(abs(normal)), Vec3d(error));
        CHECK(side * dot(moved, Vec3d(normal)) >= corner);
        CHECK(length(moved) <= 2.0 * corner + 1e-2);
    }
}

TEST_CASE("on an axis-aligned plane only that axis is moved", "[unit][ray]")
{
    const Vec3f p(1, 0, 2);
    const Vec3f up(0, 1, 0);
    const Vec3f moved = offset_origin(p, clearance(Vec3f(1e-6f, 0.f, 1e-6f), abs(p), up), up, Vec3f(1, 1, 0));
    CHECK(moved.x == 1.f);
    CHECK(moved.y > 0.f);
    CHECK(moved.y < 1e-30f);
    CHECK(moved.z == 2.f);
    CHECK(offset_origin(p, clearance(Vec3f(0.f), abs(p), up), up, Vec3f(1, -1, 0)).y < 0.f);
}

TEST_CASE("a spawned ray starts beside its surface", "[unit][ray]")
{
    SurfacePoint at;
    at.position = Vec3f(1, 1, 1);
    at.clearance = 1e-6f;
    at.geometric_normal = Vec3f(0, 0, 1);
    const Ray up = at.spawn_ray(Vec3f(0, 3, 4));
    CHECK(up.origin.z > 1.f);
    CHECK(up.direction == Vec3f(0, 3, 4));
    CHECK(up.t_max == infinity);
    CHECK(at.spawn_ray(Vec3f(0, 3, -4)).origin.z < 1.f);
}
