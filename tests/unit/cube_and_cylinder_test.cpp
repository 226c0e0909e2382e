// SPDX-License-Identifier: MIT

#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"

#include <cmath>

namespace plumb {
class Cube;
class Cylinder;
class Diffuse;
class Disk;
class Rectangle;
class Sphere;
} // namespace plumb

using namespace plumb;
using namespace plumb::test;

namespace {

Scene alone(std::unique_ptr<Shape> shape)
{
    std::vector<SceneObject> objects;
    objects.push_back(
        {std::move(shape), ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "shape"});
    return Scene(std::move(objects), {});
}

void check_uv(const Scene& scene, const Vec3f& from, const Vec3f& to, const Vec2f& uv)
{
    CAPTURE(from, to);
    const auto at = scene.intersect({from, to - from, 0.f, infinity});
    REQUIRE(at);
    CHECK((at->uv - uv).length() < 1e-5f);
}

} // namespace

TEST_CASE("a cube: size, front and the uv of its faces", "[unit][shape]")
{
    const auto params = [] { return ParamsBuilder("shape", "cube").number("width", 2.0); };
    const auto cube = params().build<Cube, Shape>();
    CHECK(cube->area() == Approx(24.f));
    CHECK(cube->bounds().min == Vec3f(-1));
    CHECK(cube->bounds().max == Vec3f(1));
    CHECK(ParamsBuilder("shape", "cube").point("center", Vec3f(1, 2, 3)).build<Cube, Shape>()->bounds().max ==
          Vec3f(1.5f, 2.5f, 3.5f));

    // As Mitsuba: at (.4, .6) of a face by its two other axes, in their order.
    const Scene scene = alone(params().build<Cube, Shape>());
    const float a = -0.2f, b = 0.2f;
    check_uv(scene, {5, a, b}, {0, a, b}, {0.4f, 0.4f});
    check_uv(scene, {-5, a, b}, {0, a, b}, {0.4f, 0.6f});
    check_uv(scene, {a, 5, b}, {a, 0, b}, {0.6f, 0.4f});
    check_uv(scene, {a, -5, b}, {a, 0, b}, {0.6f, 0.4f});
    check_uv(scene, {a, b, 5}, {a, b, 0}, {0.6f, 0.4f});
    check_uv(scene, {a, b, -5}, {a, b, 0}, {0.4f, 0.4f});

    // The outside is the front, mirrored or not.
    for (const bool flip : {false, true})
        for (const double x : {1.0, -2.0}) {
            const auto shape = params()
                                   .boolean("flipNormals", flip)
                                   .transform("toWorld", *Transform::scale(Vec3d(x, 1, 1)))
                                   .build<Cube, Shape>();
            shape->prepare_sampling();
            TestRandom random(1);
            for (int i = 0; i < 50; ++i) {
                const ShapeSample sample = shape->sample_area(random.next_double(), random.next_2d());
                CHECK((dot(sample.normal, sample.position) > 0.f) == !flip);
            }
        }
    const auto tiny =
        params().transform("toWorld", *Transform::scale(Vec3d(1e-30))).complaints<Cube, Shape>();
    REQUIRE(tiny.size() == 1);
    CHECK(tiny[0] == "error: toWorld leaves the shape without an area; scale the scene");
}

TEST_CASE("a cylinder: size, uv, both sides, and rays that miss it", "[unit][shape]")
{
    const auto params = [] { return ParamsBuilder("shape", "cylinder"); };
    const auto moved = params().point("p1", Vec3f(0, 2, 0)).number("radius", 0.5).build<Cylinder, Shape>();
    CHECK(moved->area() == Approx(2.0 * pi_d));
    CHECK(length(moved->bounds().min - Vec3f(-0.5f, 0, -0.5f)) < 1e-6f);
    CHECK(length(moved->bounds().max - Vec3f(0.5f, 2, 0.5f)) < 1e-6f);

    const Scene scene = alone(params().build<Cylinder, Shape>());
    const float s = std::sqrt(0.5f);
    check_uv(scene, {5, 5, 0.25f}, {0, 0, 0.25f}, {0.125f, 0.25f});
    check_uv(scene, {-5, 5, 0.75f}, {0, 0, 0.75f}, {0.375f, 0.75f});
    check_uv(scene, {0, -5, 0.5f}, {0, 0, 0.5f}, {0.75f, 0.5f});
    const auto inside = scene.intersect({Vec3f(0, 0, 0.5f), Vec3f(1, 1, 0)});
    REQUIRE(inside);
    CHECK(length(inside->geometric_normal - Vec3f(s, s, 0)) < 1e-6f); // the front is outside
    CHECK((inside->uv - Vec2f(0.125f, 0.5f)).length() < 1e-6f);
    CHECK_FALSE(scene.intersect({Vec3f(0, 0, 5), Vec3f(0, 0, -1)}));                // along the axis
    CHECK_FALSE(scene.intersect({Vec3f(1, 0, 5), Vec3f(0, 0, -1)}));                // along the side
    CHECK_FALSE(scene.intersect({Vec3f(5, 0, 1.01f), Vec3f(-1, 0, 0)}));            // above
    const auto through = scene.intersect({Vec3f(-1.5f, 0, 2), Vec3f(1, 0, -0.6f)}); // in at the open end
    REQUIRE(through);
    CHECK(length(through->position - Vec3f(1, 0, 0.5f)) < 1e-6f);
    CHECK(alone(params().boolean("flipNormals", true).build<Cylinder, Shape>())
              .intersect({Vec3f(5, 0, 0.5f), Vec3f(-1, 0, 0)})
              ->geometric_normal.x < -0.99f);

    // An axis that points down, and scales along and across it.
    const auto down = params().point("p1", Vec3f(0, 0, -1)).build<Cylinder, Shape>();
    CHECK(down->bounds().min.z == -1.f);
    CHECK(params().transform("toWorld", *Transform::scale(Vec3d(2, 2, 3))).build<Cylinder, Shape>()->area() ==
          Approx(12.0 * pi_d));
}

TEST_CASE("cylinders that are none are refused", "[unit][shape]")
{
    const auto complaint = [](const ParamsBuilder& params) {
        const auto all = params.complaints<Cylinder, Shape>();
        REQUIRE(all.size() == 1);
        return all[0];
    };
    const auto params = [] { return ParamsBuilder("shape", "cylinder"); };
    CHECK(complaint(params().point("p1", Vec3f(0))) ==
          "error: p1 must differ from p0: the axis runs from there to here");
    CHECK(complaint(params().transform("toWorld", *Transform::scale(Vec3d(1, 2, 1)))) ==
          "error: toWorld makes the cylinder oblique or its cross-section an ellipse; use a mesh");
    CHECK(complaint(params().number("radius", 0.0)) == "error: radius must be greater than 0, not 0");
    CHECK(complaint(params().number("radius", 1e38)) ==
          "error: radius gives the cylinder area 6.28319e+38: its points and its area must be numbers that a "
          "float "
          "can "
          "hold, and the area positive; scale the scene");
}

TEST_CASE("flipNormals turns the front of every shape", "[unit][shape]")
{
    const auto front = [](const auto& shape, const Vec3f& from) {
        return dot(shape.intersect({from, -from})->geometric_normal, from) > 0.f;
    };
    for (const bool flip : {false, true}) {
        CHECK(front(alone(ParamsBuilder("shape", "rectangle")
                              .boolean("flipNormals", flip)
                              .build<Rectangle, Shape>()),
                    {0.1f, 0.2f, 3}) == !flip);
        CHECK(front(alone(ParamsBuilder("shape", "disk").boolean("flipNormals", flip).build<Disk, Shape>()),
                    {0.1f, 0.2f, 3}) == !flip);
        CHECK(
            front(alone(ParamsBuilder("shape", "sphere").boolean("flipNormals", flip).build<Sphere, Shape>()),
                  {0.1f, 0.2f, 3}) == !flip);
    }
    const Scene sphere =
        alone(ParamsBuilder("shape", "sphere").boolean("flipU", true).build<Sphere, Shape>());
    check_uv(sphere, {0, 5, 0}, {0, 0, 0}, {0.25f, 0.5f});
}
