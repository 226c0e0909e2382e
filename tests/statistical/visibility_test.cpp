// SPDX-License-Identifier: MIT

// The integrators that look at geometry alone.
//
// [1] Siegel and Howell, "Thermal Radiation Heat Transfer", configuration factor of a differential element to a disk

#include "support/catch.h"
#include "support/integrators.h"

#include <cmath>

using namespace plumb;
using namespace plumb::test;

namespace {

const ChooseRay at_the_floor = ray_to(Vec3f(3.f, 4.f, 3.f), Vec3f(0.f));
const ChooseRay at_the_sky = ray_to(Vec3f(3.f, 4.f, 3.f), Vec3f(4.f, 8.f, 3.f));

// A ball of radius 1, 2 above the origin of a large floor: from there it covers the angle asin(1/2).
Scene ball_over_floor()
{
    return LittleScene()
        .rectangle(Vec3f(0.f), 50.f, 50.f, Vec3f(0, 1, 0), diffuse(0.5f))
        .sphere(Vec3f(0, 2, 0), 1.f, diffuse(0.5f))
        .build();
}

double mean_of(const ParamsBuilder& params, const Scene& scene, const ChooseRay& ray)
{
    return estimate(scene, *make_integrator(params, scene), ray, 1, 1).mean();
}

void check(const ParamsBuilder& params, const Scene& scene, double expected)
{
    const auto integrator = make_integrator(params, scene);
    check_mean(
        params.type(), expected,
        [&](std::uint64_t n, std::uint64_t seed) {
            return estimate(scene, *integrator, at_the_floor, n, seed);
        },
        10000, sidak_level(significance, 6));
}

} // namespace

TEST_CASE("ambient occlusion is the cosine-weighted open part of the sky", "[statistical][visibility]")
{
    const Scene scene = ball_over_floor();
    const double open = 1.0 - 0.25; // sin^2 of the angle, [1]
    check(integrator_params("ao"), scene, open);
    check(integrator_params("ao").integer("nSamples", 3).string("warp-type", "uniform-hemisphere"), scene,
          open);
    CHECK(mean_of(integrator_params("ao"), scene, at_the_sky) == 0.0);
}

TEST_CASE("average visibility counts occluders within its length", "[statistical][visibility]")
{
    const Scene scene = ball_over_floor();
    // The solid angle of the cone, 2 pi (1 - cos 30), over that of the hemisphere.
    check(integrator_params("av").number("length", 100.0), scene, std::cos(pi_d / 6));
    // A sphere of radius 1.5 about the point meets the ball where the angle's cosine is
    // (1.5^2 + 2^2 - 1) / (2 * 1.5 * 2) = 7/8.
    check(integrator_params("av").number("length", 1.5), scene, 7.0 / 8.0);
    CHECK(mean_of(integrator_params("av").number("length", 0.99), scene, at_the_floor) == 1.0);
    CHECK(mean_of(integrator_params("av").number("length", 1.0), scene, at_the_sky) == 1.0);
}

TEST_CASE("depth is one over the distance", "[statistical][visibility]")
{
    const Scene scene = ball_over_floor();
    CHECK(mean_of(integrator_params("depth"), scene, at_the_floor) == Approx(1.0 / std::sqrt(34.0)));
    CHECK(mean_of(integrator_params("depth"), scene, ray_to(Vec3f(0, 9, 0), Vec3f(0, 2, 0))) ==
          Approx(1.0 / 6.0));
    CHECK(mean_of(integrator_params("depth"), scene, at_the_sky) == 0.0);
}

TEST_CASE("normals are shown as absolute values", "[statistical][visibility]")
{
    const Scene scene = LittleScene().sphere(Vec3f(1.f, 2.f, 3.f), 2.f, diffuse(0.5f)).build();
    const auto normals = make_integrator(integrator_params("normals"), scene);
    Tracer tracer(scene);
    const auto sampler = independent_sampler();
    const Vec3f n = normalize(Vec3f(-2.f, 1.f, -3.f));
    const Color seen = normals->radiance(tracer, *sampler, {Vec3f(1.f, 2.f, 3.f) + n * 10.f, -n});
    CHECK(seen.r == Approx(-n.x));
    CHECK(seen.g == Approx(n.y));
    CHECK(seen.b == Approx(-n.z));
    CHECK(normals->radiance(tracer, *sampler, {Vec3f(0.f, 9.f, 9.f), Vec3f(0, 1, 0)}).is_black());
}
