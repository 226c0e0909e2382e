// SPDX-License-Identifier: MIT

// Closed scenes whose radiance is a geometric series: in a room whose walls all emit L and reflect the fraction a,
// every direction at every point shows L (1 + a + ... + a^k) after k bounces.

#include "support/catch.h"
#include "support/integrators.h"

#include <cmath>

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr double albedo = 0.6;
const ChooseRay into_the_room = rays_around(Vec3f(0.1f, 0.2f, -0.3f), Vec3f(0.9f, -0.1f, 0.4f), 0.5f);

double partial_sum(int bounces)
{
    double sum = 0.0;
    for (int i = 0; i <= bounces; ++i) sum += std::pow(albedo, i);
    return sum;
}

void check_all(const std::vector<NamedParams>& integrators, const Scene& scene, const ChooseRay& rays,
               double expected, std::uint64_t samples, double level)
{
    for (const NamedParams& named : integrators) {
        const auto integrator = make_integrator(named.params, scene);
        check_mean(
            named.name, expected,
            [&](std::uint64_t n, std::uint64_t seed) { return estimate(scene, *integrator, rays, n, seed); },
            samples, level, 1, 1e-5);
    }
}

} // namespace

TEST_CASE("an emissive room shows the partial sum for each maxDepth", "[statistical][furnace]")
{
    const Scene room = LittleScene().room(diffuse(float(albedo)), Color(1.f)).build();
    const double level = sidak_level(significance, 2 * 10 + 3 * 8);
    for (const int bounces : {0, 1, 2, 5}) {
        INFO("maxDepth " << bounces);
        check_all(path_tracers(bounces, bounces <= 1), room, into_the_room, partial_sum(bounces), 4000,
                  level);
    }
    INFO("no maxDepth");
    check_all(path_tracers(-1, false), room, into_the_room, 1.0 / (1.0 - albedo), 40000, level);
}

TEST_CASE("absorbing emitters show what they emit and nothing else", "[statistical][furnace]")
{
    const Scene room = LittleScene().room(diffuse(float(albedo)), Color(1.f)).absorbing_emitters().build();
    check_all(path_tracers(-1), room, into_the_room, 1.0, 100, significance);
    check_all(direct_light_integrators(), room, into_the_room, 1.0, 100, significance);
}

TEST_CASE("a convex diffuse body in a uniform environment shows its albedo", "[statistical][furnace]")
{
    const Scene scene = LittleScene().sphere(Vec3f(0.f), 1.f, diffuse(0.7f)).environment(Color(2.f)).build();
    const ChooseRay rays = rays_around(Vec3f(0.f, 0.f, 5.f), Vec3f(0.f), 0.4f);
    const double level = sidak_level(significance, 40);
    check_all(path_tracers(-1), scene, rays, 1.4, 5000, level);
    check_all(direct_light_integrators(), scene, rays, 1.4, 5000, level);
}

// Nothing is absorbed, so every ray, refracted and totally reflected inside as often as it likes, brings the same
// radiance. What refraction does to radiance on the way in, it undoes on the way out.
TEST_CASE("a glass body in a uniform environment cannot be seen", "[statistical][furnace]")
{
    const Scene scene = LittleScene()
                            .sphere(Vec3f(0.f), 1.f, glass())
                            .sphere(Vec3f(0.f, 0.f, -0.2f), 0.5f, mirror())
                            .environment(Color(1.f))
                            .build();
    const ChooseRay rays = rays_around(Vec3f(0.f, 0.f, 5.f), Vec3f(0.f), 0.9f);
    check_all(path_tracers(-1), scene, rays, 1.0, 30000, sidak_level(significance, 10));
    check_all({{"whitted", integrator_params("whitted")}}, scene, rays, 1.0, 30000, significance);
}

// Inside glass the throughput is 1/eta^2; roulette must not mistake that for absorption.
TEST_CASE("roulette does not end paths because they are in glass", "[statistical][furnace]")
{
    const Scene scene = LittleScene().sphere(Vec3f(0.f), 1.f, glass()).environment(Color(1.f)).build();
    const auto integrator = make_integrator(integrator_params("path").integer("rrDepth", 0), scene);
    const auto result =
        estimate(scene, *integrator, ray_to(Vec3f(0, 0, 5), Vec3f(0.3f, 0.2f, 0.f)), 20000, 1);
    // Two refractions, or one reflection, survive with 0.95 each: the values are 0, 1/0.95, 1/0.95^2, ... and their
    // variance is near 1/0.95^2 - 1 = 0.108. With 1/eta^2 = 0.44 in the place of 0.95 it would be above 1.
    CHECK(result.variance() < 0.2);
}
