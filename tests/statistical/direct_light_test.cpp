// SPDX-License-Identifier: MIT

// Direct light on a diffuse floor, against closed forms.
//
// [1] Siegel and Howell, "Thermal Radiation Heat Transfer", configuration factors of a differential element to a
//     sphere and to a parallel rectangle

#include "support/catch.h"
#include "support/integrators.h"

#include <cmath>

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr double albedo = 0.5;
const Vec3f floor_point(0.7f, 0.f, 0.4f);
const ChooseRay at_the_floor = ray_to(Vec3f(3.f, 1.5f, 3.f), floor_point);

LittleScene with_floor()
{
    LittleScene scene;
    scene.rectangle(Vec3f(0.f), 12.f, 12.f, Vec3f(0, 1, 0), diffuse(float(albedo)));
    return scene;
}

// The part of a Lambertian's irradiance that comes from a body; 1 is a full hemisphere of the same radiance.

// [1]: a sphere of radius r wholly above the horizon.
double factor_of_sphere(const Vec3f& center, double r)
{
    const Vec3f to = center - floor_point;
    const double d = length(to);
    return r * r / (d * d) * (to.y / d);
}

// [1]: a parallel rectangle at height h, one of whose corners is above the point; a and b may be negative.
double factor_of_corner(double a, double b, double h)
{
    const double x = a / h, y = b / h;
    const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * pi_d);
}

// A rectangle facing down, from (x0, h, z0) to (x1, h, z1).
double factor_of_rectangle(double x0, double x1, double z0, double z1, double h)
{
    const double px = floor_point.x, pz = floor_point.z;
    return factor_of_corner(x1 - px, z1 - pz, h) - factor_of_corner(x0 - px, z1 - pz, h) -
           factor_of_corner(x1 - px, z0 - pz, h) + factor_of_corner(x0 - px, z0 - pz, h);
}

double cosine_over_square(const Vec3f& position)
{
    const Vec3f to = position - floor_point;
    const double d = length(to);
    return to.y / (d * d * d);
}

void check_all(const Scene& scene, double expected, std::uint64_t samples = 10000)
{
    std::vector<NamedParams> integrators = direct_light_integrators();
    for (const NamedParams& named : path_tracers(1)) integrators.push_back(named);
    const double level = sidak_level(significance, 6 * integrators.size());
    for (const NamedParams& named : integrators) {
        const auto integrator = make_integrator(named.params, scene);
        check_mean(
            named.name, expected,
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *integrator, at_the_floor, n, seed);
            },
            samples, level, 1, 1e-5);
    }
}

} // namespace

TEST_CASE("the floor under a sphere light", "[statistical][direct]")
{
    const Vec3f center(0.f, 2.f, 0.f);
    const Scene scene = with_floor().sphere(center, 0.8f, diffuse(0.5f), Color(10.f)).build();
    check_all(scene, albedo * 10.0 * factor_of_sphere(center, 0.8));
}

TEST_CASE("the floor under a rectangle light", "[statistical][direct]")
{
    const Scene scene =
        with_floor()
            .rectangle(Vec3f(0.2f, 1.5f, 0.1f), 2.f, 1.f, Vec3f(0, -1, 0), diffuse(0.5f), Color(3.f))
            .build();
    // The rectangle's width runs along the world's x axis.
    check_all(scene, albedo * 3.0 * factor_of_rectangle(-0.8, 1.2, -0.4, 0.6, 1.5));
}

TEST_CASE("the floor under a point light", "[statistical][direct]")
{
    const Vec3f position(-1.f, 2.f, 1.f);
    const Scene scene = with_floor().point_light(position, Color(6.f)).build();
    check_all(scene, albedo / pi_d * 6.0 * cosine_over_square(position), 10);
}

TEST_CASE("the floor under a directional light", "[statistical][direct]")
{
    const Scene scene = with_floor().directional_light(Vec3f(2.f, 1.f, 2.f), Color(4.f)).build();
    check_all(scene, albedo / pi_d * 4.0 / 3.0, 10);
}

TEST_CASE("the floor under an environment", "[statistical][direct]")
{
    const Scene scene = with_floor().environment(Color(2.f)).build();
    check_all(scene, albedo * 2.0);
}

// Lamps hide what is behind them.
TEST_CASE("the floor under all kinds of light at once", "[statistical][direct]")
{
    const Vec3f sphere(-1.5f, 2.f, -1.f), point(3.f, 2.f, 1.f);
    const Scene scene =
        with_floor()
            .sphere(sphere, 0.7f, diffuse(0.5f), Color(5.f))
            .rectangle(Vec3f(0.7f, 1.2f, 0.4f), 1.f, 0.8f, Vec3f(0, -1, 0), diffuse(0.f), Color(3.f))
            .point_light(point, Color(4.f))
            .directional_light(Vec3f(-1.f, 0.2f, 1.f), Color(1.5f))
            .environment(Color(0.8f))
            .build();
    const double ball = factor_of_sphere(sphere, 0.7);
    const double sheet = factor_of_rectangle(0.2, 1.2, 0.0, 0.8, 1.2);
    const double of_points = 4.0 * cosine_over_square(point) + 1.5 * 0.2 / std::sqrt(2.04);
    check_all(scene, albedo * (5.0 * ball + 3.0 * sheet + 0.8 * (1 - ball - sheet) + of_points / pi_d));
}

TEST_CASE("direct light includes lamps in mirrors", "[statistical][direct]")
{
    const Scene scene = LittleScene()
                            .rectangle(Vec3f(0.f), 4.f, 4.f, Vec3f(0, 1, 0), mirror())
                            .rectangle(Vec3f(0, 2, 0), 4.f, 4.f, Vec3f(0, -1, 0), diffuse(0.f), Color(3.f))
                            .build();
    const ChooseRay at_the_mirror = ray_to(Vec3f(0.5f, 1.f, 0.f), Vec3f(0.f));
    for (const NamedParams& named : direct_light_integrators()) {
        INFO(named.name);
        const auto integrator = make_integrator(named.params, scene);
        CHECK(estimate(scene, *integrator, at_the_mirror, 10, 1).mean() == Approx(3.0));
    }
}

TEST_CASE("whitted follows mirrors to the first diffuse surface and no further", "[statistical][direct]")
{
    const Vec3f center(0.f, 2.f, 0.f);
    // The mirror stands behind the camera and shows the floor point.
    const Scene scene = with_floor()
                            .sphere(center, 0.8f, diffuse(0.5f), Color(10.f))
                            .rectangle(Vec3f(4.f, 1.f, 0.4f), 2.f, 2.f, Vec3f(-1, 0, 0), mirror())
                            .build();
    const auto whitted = make_integrator(integrator_params("whitted"), scene);
    // At height 1 on the mirror, halfway between the floor point and the camera at (0.7, 2, 0.4).
    const ChooseRay by_the_mirror = ray_to(Vec3f(0.7f, 2.f, 0.4f), Vec3f(4.f, 1.f, 0.4f));
    check_mean(
        "whitted", albedo * 10.0 * factor_of_sphere(center, 0.8),
        [&](std::uint64_t n, std::uint64_t seed) {
            return estimate(scene, *whitted, by_the_mirror, n, seed);
        },
        4000, significance);
}

TEST_CASE("simple adds up point lights, or brings its own", "[statistical][direct]")
{
    const Vec3f a(-1.f, 2.f, 1.f), b(2.f, 1.f, 0.f);
    const Scene scene = with_floor()
                            .point_light(a, Color(6.f))
                            .point_light(b, Color(2.f))
                            .directional_light(Vec3f(0.f, 2.f, 0.f), Color(1.f))
                            .sphere(Vec3f(0.f, 5.f, 0.f), 0.1f, diffuse(0.5f), Color(1000.f))
                            .build();
    const auto light_of = [&](const ParamsBuilder& params) {
        return estimate(scene, *make_integrator(params, scene), at_the_floor, 1, 1).mean();
    };
    CHECK(light_of(integrator_params("simple")) ==
          Approx(albedo / pi_d * (6.0 * cosine_over_square(a) + 2.0 * cosine_over_square(b) + 1.0)));
    CHECK(light_of(integrator_params("simple").point("position", a).color("energy", Color(30.f))) ==
          Approx(30.0 / (4.0 * pi_d * pi_d) * cosine_over_square(a)));
    // Below the floor, and behind the lamp: nothing.
    CHECK(light_of(integrator_params("simple").point("position", -a).color("energy", Color(30.f))) == 0.0);
    const Vec3f behind = floor_point + (Vec3f(0.f, 5.f, 0.f) - floor_point) * 2.f;
    CHECK(light_of(integrator_params("simple").point("position", behind).color("energy", Color(30.f))) ==
          0.0);
}
