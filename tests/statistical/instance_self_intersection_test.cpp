// SPDX-License-Identifier: MIT

// A ray that leaves a surface inside an instance does not find it again.
//
// Triangles from 1e-3 to 1e4 in size, up to 1e3 times their size away from the origin of their group, slivers to 1 : 1000;
// maps that turn, scale by 10^-2.5 to 10^2.5 per axis, mirror and move by up to 1e3 times the size. Rays start on both
// sides, also on edges, in all directions and down to angles of 1e-9 with the plane: any hit is wrong.

#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"

#include "base/float_mode.h"
#include "support/catch.h"
#include "support/lamp.h"
#include "support/random.h"

#include <fmt/format.h>

namespace plumb::test {
namespace {

struct Count {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t hits_without_offset = 0;
};

Transform random_map(TestRandom& random, double spread, double offset)
{
    const auto factor = [&] {
        return std::pow(10.0, random.between(-spread, spread)) * (random.next_1d() < 0.5f ? -1.0 : 1.0);
    };
    const Vec3d moved(random.between(-offset, offset), random.between(-offset, offset),
                      random.between(-offset, offset));
    const Vec3d axes[2] = {Vec3d(random.direction()), Vec3d(random.direction())};
    const double angles[2] = {random.between(0, 360), random.between(0, 360)};
    const Vec3d factors(factor(), factor(), factor());
    return Transform::translate(moved) * Transform::rotate(axes[0], angles[0]) * *Transform::scale(factors) *
           Transform::rotate(axes[1], angles[1]);
}

std::optional<Scene> scene_of(std::unique_ptr<Shape> shape, const Transform& transform)
{
    const auto map = InstanceMap::from(transform);
    if (!map) return std::nullopt;
    std::vector<SceneObject> objects;
    objects.push_back(
        {std::move(shape), ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "shape"});
    std::vector<Instance> instances;
    instances.push_back({*map, std::make_shared<const Group>(std::move(objects), "group"), "instance"});
    return Scene({}, {}, {}, std::move(instances));
}

Vec3f leaving_direction(TestRandom& random, const Vec3f& normal)
{
    const Vec3f any = random.direction();
    if (random.next_1d() < 0.25f) return any;
    const Vec3d tangent = normalize(cross(Vec3d(normal), Vec3d(any)));
    const double slope = std::pow(10.0, random.between(-9, -0.5)) * (random.next_1d() < 0.5f ? -1.0 : 1.0);
    return Vec3f(tangent + Vec3d(normal) * slope);
}

// aim: chooses a point of the surface in object space.
template <class Aim>
void leave(const Scene& scene, const Aim& aim, bool is_convex, int rays, TestRandom& random, Count& count)
{
    const Instance& instance = scene.instances()[0];
    const Box3f box = scene.bounds();
    const float size = std::max(length(box.size()), 1e-30f);
    for (int i = 0; i < rays; ++i) {
        const Vec3f target(instance.to_world(aim(i)));
        const Vec3f from = target + random.direction() * size;
        const auto at = scene.intersect({from, target - from});
        if (!at) continue;
        const Vec3f direction = leaving_direction(random, at->geometric_normal);
        const float cosine = dot(direction, at->geometric_normal);
        if (cosine == 0.f || (is_convex && cosine < 0.f)) continue;
        const Ray ray = at->spawn_ray(direction);
        if (!is_traceable(ray)) continue;
        ++count.rays;
        count.hits += scene.intersect(ray).has_value();
        count.hits_without_offset += scene.occluded({at->position, direction});
    }
}

Count leave_triangles(int maps, int rays, std::uint64_t seed)
{
    const FlushDenormals mode;
    TestRandom random(seed);
    Count count;
    for (int m = 0; m < maps; ++m) {
        const double size = std::pow(10.0, random.between(-3, 4));
        const double offset = size * std::pow(10.0, random.between(0, 3));
        const double thin = m % 3 == 0 ? std::pow(10.0, random.between(-3, 0)) : 1.0;
        const Vec3d corner(random.between(-offset, offset), random.between(-offset, offset),
                           random.between(-offset, offset));
        const Vec3d a = Vec3d(random.direction()) * size;
        const Vec3d b = normalize(cross(a, Vec3d(random.direction()))) * (size * thin);
        const Transform map =
            random_map(random, m % 2 == 0 ? 2.5 : 1.0, size * std::pow(10.0, random.between(-1, 3)));
        std::string text;
        for (const Vec3d& p : {corner, corner + a, corner + b})
            text += fmt::format("v {} {} {}\n", float(p.x), float(p.y), float(p.z));
        std::unique_ptr<Shape> shape;
        try {
            shape = mesh(text + "f 1 2 3\n");
        } catch (const std::exception&) {
            continue; // floats do not hold it
        }
        const auto scene = scene_of(std::move(shape), map);
        if (!scene) continue;
        const auto aim = [&](int i) {
            const double u = std::sqrt(random.next_double()), v = i % 5 == 0 ? 0.0 : random.next_double();
            return corner + a * (u * (1.0 - v)) + b * (u * v);
        };
        leave(*scene, aim, false, rays, random, count);
    }
    return count;
}

} // namespace

TEST_CASE("rays that leave a triangle in an instance do not find it again",
          "[statistical][self_intersection][instance]")
{
    const Count count = leave_triangles(1500, 200, 41);
    CAPTURE(count.rays, count.hits_without_offset);
    CHECK(count.rays > 100000);
    CHECK(count.hits == 0);
    CHECK(count.hits_without_offset > count.rays / 100); // the test can fail
}

TEST_CASE("many rays that leave a triangle in an instance do not find it again",
          "[statistical][self_intersection][instance][slow]")
{
    const Count count = leave_triangles(15000, 250, 42);
    CHECK(count.rays > 1500000);
    CHECK(count.hits == 0);
}

TEST_CASE("rays that leave an ellipsoid outwards do not find it again",
          "[statistical][self_intersection][instance]")
{
    const FlushDenormals mode;
    TestRandom random(43);
    Count count;
    for (int m = 0; m < 300; ++m) {
        const double radius = std::pow(10.0, random.between(-3, 4));
        const double offset = radius * std::pow(10.0, random.between(-1, 3));
        const Vec3f center = random.direction() * static_cast<float>(offset);
        const Transform map = random_map(random, 1.0, radius * std::pow(10.0, random.between(-1, 3)));
        const auto scene = scene_of(ball(center, radius), map);
        REQUIRE(scene);
        const auto aim = [&](int) { return Vec3d(center) + Vec3d(random.direction()) * (radius * 0.99); };
        leave(*scene, aim, true, 300, random, count);
    }
    CAPTURE(count.rays);
    CHECK(count.rays > 20000);
    CHECK(count.hits == 0);
}

} // namespace plumb::test
