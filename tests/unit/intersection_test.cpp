// SPDX-License-Identifier: MIT

#include "shapes/intersection.h"

#include "support/catch.h"
#include "support/random.h"

using namespace plumb;
using plumb::test::TestRandom;

namespace {

Vec3f point_of(const Vec3f (&p)[3], const Barycentric& b)
{
    return p[0] * static_cast<float>(1.0 - b.u - b.v) + p[1] * static_cast<float>(b.u) +
           p[2] * static_cast<float>(b.v);
}

} // namespace

TEST_CASE("barycentric coordinates of the point that a ray was aimed at", "[unit][intersection]")
{
    TestRandom random;
    for (int i = 0; i < 1000; ++i) {
        const Vec3f p[3] = {random.direction(), random.direction(), random.direction()};
        const auto u = static_cast<float>(random.between(0.0, 0.5));
        const auto v = static_cast<float>(random.between(0.0, 0.5));
        const Vec3f target = point_of(p, {u, v});
        const Vec3f origin = random.direction() * 5.f;
        const Vec3f direction = (target - origin) * static_cast<float>(random.between(0.1, 3.0));
        // Aim is only as good as a float; seen at a grazing angle, or in a sliver, it misses by more.
        const Vec3f normal = cross(p[1] - p[0], p[2] - p[0]);
        if (std::abs(dot(normal, normalize(direction))) < 0.1f) continue;
        const Barycentric b = intersect_triangle(Ray{origin, direction}, {p[0], p[1], p[2]});
        CHECK(length(point_of(p, b) - target) < 2e-5f);
    }
}

TEST_CASE("barycentric coordinates stay inside the triangle", "[unit][intersection]")
{
    const Vec3f p0(0, 0, 0);
    const Vec3f p1(1, 0, 0);
    const Vec3f p2(0, 1, 0);
    const auto at = [&](float x, float y) {
        return intersect_triangle(Ray{Vec3f(x, y, 1), Vec3f(0, 0, -1)}, {p0, p1, p2});
    };
    for (const Vec2f& q : {Vec2f(-1e-3f, 0.5f), Vec2f(0.5f, -1e-3f), Vec2f(0.501f, 0.5f), Vec2f(2, -1),
                           Vec2f(-1, -1), Vec2f(3, 3)}) {
        const Barycentric b = at(q.x, q.y);
        CHECK(b.u >= 0.0);
        CHECK(b.v >= 0.0);
        CHECK(b.u + b.v <= 1.0 + 1e-15);
    }
    CHECK(at(0.25f, 0.5f).u == 0.25);
    CHECK(at(0.25f, 0.5f).v == 0.5);
    // In the plane of the triangle, or without area: some point of it.
    const Barycentric edge_on = intersect_triangle(Ray{Vec3f(-1, 0.2f, 0), Vec3f(1, 0, 0)}, {p0, p1, p2});
    CHECK((edge_on.u >= 0.0 && edge_on.v >= 0.0 && edge_on.u + edge_on.v <= 1.0));
    const Barycentric no_area = intersect_triangle(Ray{Vec3f(0, 0, 1), Vec3f(0, 0, -1)}, {p0, p1, p1});
    CHECK((no_area.u >= 0.0 && no_area.v >= 0.0 && no_area.u + no_area.v <= 1.0));
}

TEST_CASE("a sphere is met from outside and from inside", "[unit][intersection]")
{
    const Vec3f center(1, 2, 3);
    const Ray outside{Vec3f(1, 2, -7), Vec3f(0, 0, 1)};
    CHECK(intersect_sphere(outside, center, 2.f) == 8.0);
    CHECK(intersect_sphere({outside.origin, Vec3f(0, 0, 4)}, center, 2.f) == 2.0); // t counts directions
    CHECK(intersect_sphere({center, Vec3f(0, 1, 0)}, center, 2.f) == 2.0);
    CHECK(intersect_sphere({Vec3f(1, 2, 4), Vec3f(0, 0, 1)}, center, 2.f) == 1.0);
    CHECK_FALSE(intersect_sphere({outside.origin, Vec3f(0, 0, -1)}, center, 2.f)); // behind
    CHECK_FALSE(intersect_sphere({Vec3f(4, 2, -7), Vec3f(0, 0, 1)}, center, 2.f)); // beside
}

TEST_CASE("a sphere is met within the ray's range only", "[unit][intersection]")
{
    const Vec3f origin(0, 0, -5);
    const Vec3f direction(0, 0, 1);
    CHECK(intersect_sphere({origin, direction, 4.5f, infinity}, Vec3f(0.f), 1.f) == 6.0);
    CHECK(intersect_sphere({origin, direction, 4.f, infinity}, Vec3f(0.f), 1.f) == 6.0); // open at its ends
    CHECK_FALSE(intersect_sphere({origin, direction, 0.f, 4.f}, Vec3f(0.f), 1.f));
    CHECK_FALSE(intersect_sphere({origin, direction, 6.f, infinity}, Vec3f(0.f), 1.f));
}

TEST_CASE("far, tiny and huge spheres are met where they are", "[unit][intersection]")
{
    TestRandom random(4);
    for (const double scale : {1e-4, 1.0, 1e5})
        for (const double ratio : {1e-4, 1.0, 1e6}) { // distance over radius
            const auto radius = static_cast<float>(scale);
            for (int i = 0; i < 100; ++i) {
                const Vec3f center = random.direction() * static_cast<float>(3.0 * scale);
                const Vec3f normal = random.direction();
                const Vec3d target = Vec3d(center) + normalize(Vec3d(normal)) * static_cast<double>(radius);
                const Vec3f origin = Vec3f(target) + normal * static_cast<float>(ratio * scale);
                const Vec3d towards = target - Vec3d(origin);
                const Ray ray{origin, Vec3f(towards)};
                const auto t = intersect_sphere(ray, center, radius);
                REQUIRE(t);
                const Vec3d p = Vec3d(ray.origin) + Vec3d(ray.direction) * *t;
                // On the sphere to double precision of the distance travelled.
                CHECK(std::abs(length(p - Vec3d(center)) - radius) <=
                      1e-14 * (length(towards) + 4.0 * scale));
            }
        }
}
