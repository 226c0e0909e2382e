// SPDX-License-Identifier: MIT

// Closed rooms are tight: no ray that starts on a wall, however close to an edge, gets out. Rooms of rectangles and of one
// mesh, upright and turned, as far from the origin as 1e5 times their size. Where points are not kept away from the edges
// (edge_clearance in src/shapes/triangle.h), 2 to 3 % of these rays leave, at every distance: a quarter go to an edge.

#include "base/float_mode.h"
#include "plumb/model/shape.h"
#include "support/catch.h"
#include "support/lamp.h"
#include "support/little_scene.h"
#include "support/random.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

Vec3d turned(const Transform& turn, const Vec3d& p)
{
    return turn.vector(p);
}

// The cube [-1, 1]^3, turned and moved, seen from inside.
Scene room_of_rectangles(const Transform& turn, const Vec3d& middle)
{
    const Transform to_world = Transform::translate(middle) * turn;
    LittleScene little;
    for (const Vec3f& n :
         {Vec3f(1, 0, 0), Vec3f(-1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, -1, 0), Vec3f(0, 0, 1), Vec3f(0, 0, -1)})
        little.add_shape(ParamsBuilder("shape", "rectangle")
                             .point("center", -n)
                             .number("width", 2)
                             .number("height", 2)
                             .vector("normal", n)
                             .transform("toWorld", to_world)
                             .build<Rectangle, Shape>(),
                         diffuse(0.5f));
    return little.build();
}

Scene room_of_mesh(const Transform& turn, const Vec3d& middle)
{
    std::string text;
    for (int i = 0; i < 8; ++i) {
        const Vec3d corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        const Vec3f p(turned(turn, corner) + middle);
        text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    }
    text += "f 3 7 5 1\nf 6 8 4 2\nf 5 6 2 1\nf 4 8 7 3\nf 2 4 3 1\nf 7 8 6 5\n";
    LittleScene little;
    little.add_shape(mesh(text), diffuse(0.5f));
    return little.build();
}

// Bounces in all directions; a ray that leaves is counted, and the next one starts in the middle.
std::uint64_t count_escapes(const Scene& scene, const Vec3d& middle, TestRandom& random, int bounces)
{
    std::uint64_t escapes = 0;
    Ray ray(Vec3f(middle), random.direction());
    for (int i = 0; i < bounces; ++i) {
        const auto hit = scene.intersect(ray);
        if (!hit) {
            ++escapes;
            ray = Ray(Vec3f(middle), random.direction());
            continue;
        }
        // From a quarter of the points, the next ray goes to an edge, where trouble is.
        Vec3f direction = random.direction();
        if (i % 4 == 0) {
            Vec3d edge(random.between(-1, 1), 1, 1);
            for (int axis = 0; axis < 3; ++axis)
                if (random.next_1d() < 0.5f) edge[axis] = -edge[axis];
            std::swap(edge.x, edge[static_cast<int>(random.between(0, 3))]);
            direction = Vec3f(middle + edge - Vec3d(hit->position));
        }
        if (dot(direction, hit->geometric_normal) < 0.f) direction = -direction;
        if (dot(direction, hit->geometric_normal) == 0.f) continue;
        ray = hit->spawn_ray(direction);
    }
    return escapes;
}

void check_rooms(int rooms, int bounces, std::uint64_t seed)
{
    const FlushDenormals mode;
    TestRandom random(seed);
    for (const double distance : {0.0, 1.0, 1e3, 1e5}) {
        std::uint64_t from_rectangles = 0, from_mesh = 0;
        for (int i = 0; i < rooms; ++i) {
            const bool upright = i % 2 == 0;
            const Transform turn =
                upright ? Transform() : Transform::rotate(Vec3d(random.direction()), random.between(0, 360));
            const Vec3d middle = upright ? Vec3d(distance) : Vec3d(random.direction()) * distance;
            from_rectangles += count_escapes(room_of_rectangles(turn, middle), middle, random, bounces);
            from_mesh += count_escapes(room_of_mesh(turn, middle), middle, random, bounces);
        }
        CAPTURE(distance);
        CHECK(from_rectangles == 0);
        CHECK(from_mesh == 0);
    }
}

} // namespace

TEST_CASE("closed rooms are tight", "[statistical][self_intersection]")
{
    check_rooms(10, 20000, 41);
}

TEST_CASE("closed rooms are tight for long", "[statistical][self_intersection][slow]")
{
    check_rooms(100, 400000, 42);
}
