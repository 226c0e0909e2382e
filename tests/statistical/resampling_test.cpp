// SPDX-License-Identifier: MIT

// Emitter samples of which one is followed: any number of candidates gives the same mean, and less noise.

#include "plumb/model/shape.h"

#include "support/catch.h"
#include "support/integrators.h"
#include "support/lamp.h"
#include "support/scene_text.h"

#include <fmt/format.h>

namespace plumb {
class Cube;
class RoughConductor;
class RoughPlastic;
} // namespace plumb

using namespace plumb;
using namespace plumb::test;

namespace {

MakeBsdf metal(double alpha)
{
    return [alpha] {
        return ParamsBuilder("bsdf", "roughconductor").number("alpha", alpha).build<RoughConductor, Bsdf>();
    };
}

std::unique_ptr<Bsdf> rough_plastic()
{
    return ParamsBuilder("bsdf", "roughplastic").number("alpha", 0.2).build<RoughPlastic, Bsdf>();
}

std::unique_ptr<Shape> block(const Vec3f& center, double width)
{
    return ParamsBuilder("shape", "cube").point("center", center).number("width", width).build<Cube, Shape>();
}

// A plate under lamps of every kind, some of them hidden behind a ball.
LittleScene lit_plate(const MakeBsdf& plate)
{
    LittleScene scene;
    scene.rectangle(Vec3f(0.f), 6.f, 6.f, Vec3f(0, 1, 0), plate)
        .rectangle(Vec3f(0.f, 3.f, -3.f), 6.f, 6.f, Vec3f(0, 0, 1), diffuse(0.5f))
        .sphere(Vec3f(-0.2f, 0.8f, -0.4f), 0.35f, diffuse(0.3f))
        .sphere(Vec3f(0.8f, 1.5f, -1.f), 0.3f, diffuse(0.f), Color(6.f, 5.f, 2.f))
        .rectangle(Vec3f(-1.f, 2.f, 0.5f), 1.f, 0.5f, Vec3f(0, -1, 0), diffuse(0.f), Color(2.f, 3.f, 4.f))
        .add_shape(block(Vec3f(-0.5f, 1.6f, -1.4f), 0.5), diffuse(0.f), Color(3.f, 1.f, 1.f))
        .point_light(Vec3f(1.5f, 2.f, 1.f), Color(1.f))
        .directional_light(Vec3f(1, 2, 1), Color(0.3f))
        .environment(Color(0.2f, 0.3f, 0.4f));
    return scene;
}

const ChooseRay at_the_plate = rays_around(Vec3f(0.f, 1.5f, 4.f), Vec3f(0.f, 0.f, 0.f), 0.8f);

ParamsBuilder path_mis(int candidates, int max_depth)
{
    return integrator_params("path_mis").integer("candidates", candidates).integer("maxDepth", max_depth);
}

} // namespace

TEST_CASE("any number of candidates has the same mean", "[statistical][direct][resampling]")
{
    const std::vector<std::pair<std::string, MakeBsdf>> plates{
        {"smooth metal", metal(0.03)}, {"rough metal", metal(0.4)}, {"plastic", rough_plastic}};
    for (const auto& [name, plate] : plates) {
        const Scene scene = lit_plate(plate).build();
        for (const int depth : {1, 3}) {
            const auto one = make_integrator(path_mis(1, depth), scene);
            for (const int candidates : {2, 4, 16})
                for (const char* heuristic : {"power", "balance"}) {
                    const auto several =
                        make_integrator(path_mis(candidates, depth).string("heuristic", heuristic), scene);
                    check_same_mean(
                        fmt::format("{}, depth {}, {} candidates, {}", name, depth, candidates, heuristic),
                        [&](std::uint64_t n, std::uint64_t seed) {
                            return estimate(scene, *several, at_the_plate, n, seed);
                        },
                        [&](std::uint64_t n, std::uint64_t seed) {
                            return estimate(scene, *one, at_the_plate, n, seed);
                        },
                        20000, sidak_level(significance, 36));
                }
        }
    }
}

TEST_CASE("directions alone find what candidates find", "[statistical][direct][resampling]")
{
    const Scene scene = lit_plate(metal(0.3)).build();
    const auto directions = make_integrator(integrator_params("path").integer("maxDepth", 1), scene);
    for (const int candidates : {1, 4, 16}) {
        const auto both = make_integrator(path_mis(candidates, 1), scene);
        check_same_mean(
            fmt::format("{} candidates", candidates),
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *both, at_the_plate, n, seed);
            },
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *directions, at_the_plate, n, seed);
            },
            40000, sidak_level(significance, 3));
    }
}

TEST_CASE("candidates make the light on a glossy plate less noisy", "[statistical][direct][resampling]")
{
    const Scene scene = lit_plate(metal(0.3)).build();
    const auto variance = [&](int candidates) {
        return estimate(scene, *make_integrator(path_mis(candidates, 1), scene), at_the_plate, 40000, 3)
            .variance();
    };
    const double one = variance(1);
    CHECK(variance(4) < 0.8 * one);
}

TEST_CASE("without glossy surfaces candidates change no bit", "[statistical][direct][resampling]")
{
    const Scene scene = lit_plate(diffuse(0.5f)).build();
    const auto value = [&](int candidates) {
        return estimate(scene, *make_integrator(path_mis(candidates, -1), scene), at_the_plate, 500, 3)
            .mean();
    };
    CHECK(value(1) == value(16));
}
