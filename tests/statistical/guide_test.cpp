// SPDX-License-Identifier: MIT

// Guided directions: their density, closed forms of what they find, and where there is a guide at all.

#include "integrators/caustic_guide.h"
#include "integrators/caustic_photons.h"
#include "plumb/model/guide.h"
#include "plumb/sampling/sampling.h"
#include "support/catch.h"
#include "support/integrators.h"
#include "support/placed_lamp.h"

#include <array>
#include <cstring>

#include <fmt/format.h>

namespace plumb {
class ThinDielectric;
class RoughConductor;
class RoughDielectric;
class Principled;
} // namespace plumb

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr float lamp_radiance = 30.f;
constexpr float floor_albedo = 0.5f;

// A floor, a ball of glass and one that mirrors, and a lamp above.
LittleScene balls()
{
    LittleScene scene;
    scene.rectangle(Vec3f(0.f), 6.f, 6.f, Vec3f(0, 1, 0), diffuse(floor_albedo));
    scene.sphere(Vec3f(-0.6f, 0.6f, 0.f), 0.5f, glass());
    scene.sphere(Vec3f(0.7f, 0.5f, 0.2f), 0.5f, mirror());
    scene.rectangle(Vec3f(0.3f, 3.f, 0.3f), 0.6f, 0.4f, Vec3f(0, -1, 0), diffuse(0.f), Color(lamp_radiance));
    return scene;
}

// Of a floor under a lamp that shines upwards, into a mirror at y = 2: it is lit by what seems a lamp at y = 3.
const Vec3f floor_point(0.1f, 0.f, -0.2f);
LittleScene lamp_under(const MakeBsdf& ceiling)
{
    LittleScene scene;
    scene.rectangle(Vec3f(0.f), 6.f, 6.f, Vec3f(0, 1, 0), diffuse(floor_albedo));
    scene.rectangle(Vec3f(0.f, 2.f, 0.f), 6.f, 6.f, Vec3f(0, -1, 0), ceiling);
    scene.rectangle(Vec3f(0.8f, 1.f, 0.3f), 0.2f, 0.3f, Vec3f(0, 1, 0), diffuse(0.f), Color(lamp_radiance));
    return scene;
}
Scene mirrored_lamp()
{
    return lamp_under(mirror()).build();
}

// 1 - R of a thin pane, whose faces reflect r each: R = 2 r / (1 + r), of index 1.5.
double pane_transmittance(double cos_i)
{
    const double eta = 1.5;
    const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (eta * eta));
    const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const double r = 0.5 * (s * s + p * p);
    return 1.0 - 2.0 * r / (1.0 + r);
}

// A floor under a pane at y = 1 and a lamp at y = 2, 0.3 by 0.2 about (0.5, 2, 0.2), that shines down.
Scene lamp_behind_pane()
{
    const MakeBsdf pane = [] {
        return ParamsBuilder("bsdf", "thindielectric").number("intIOR", 1.5).build<ThinDielectric, Bsdf>();
    };
    LittleScene scene;
    scene.rectangle(Vec3f(0.f), 6.f, 6.f, Vec3f(0, 1, 0), diffuse(floor_albedo));
    scene.rectangle(Vec3f(0.f, 1.f, 0.f), 6.f, 6.f, Vec3f(0, 1, 0), pane);
    scene.rectangle(Vec3f(0.5f, 2.f, 0.2f), 0.3f, 0.2f, Vec3f(0, -1, 0), diffuse(0.f), Color(lamp_radiance));
    return scene.build();
}

double light_behind_pane()
{
    const double height = 2.0;
    const double irradiance = integrate(
        [&](double x, double z) {
            const double distance2 = sqr(x - floor_point.x) + sqr(z - floor_point.z) + sqr(height);
            const double cosine = height / std::sqrt(distance2);
            return lamp_radiance * pane_transmittance(cosine) * sqr(cosine) / distance2;
        },
        0.35, 0.65, 0.1, 0.3);
    return irradiance * floor_albedo / pi_d;
}

ParamsBuilder two_bounces(bool guided)
{
    return integrator_params("path_mis").integer("maxDepth", 2).boolean("guide", guided);
}

const ChooseRay at_the_floor = ray_to(Vec3f(0.1f, 0.5f, -0.2f), floor_point);

MeanAndVariance light_at_the_floor(const Scene& scene, bool guided, std::uint64_t samples, std::uint64_t seed)
{
    return estimate(scene, *make_integrator(two_bounces(guided), scene), at_the_floor, samples, seed);
}

MakeBsdf metal(double alpha)
{
    return [alpha] {
        return ParamsBuilder("bsdf", "roughconductor").number("alpha", alpha).build<RoughConductor, Bsdf>();
    };
}
MakeBsdf frosted_glass(double alpha)
{
    return [alpha] {
        return ParamsBuilder("bsdf", "roughdielectric").number("alpha", alpha).build<RoughDielectric, Bsdf>();
    };
}

// A floor under metal, and a lamp that shines away from the floor. Balls make chains of links of both kinds, in any order.
enum class Light { lamp, point, sky };
LittleScene under_metal(double alpha, Light light)
{
    LittleScene scene;
    scene.rectangle(Vec3f(0.f), 6.f, 6.f, Vec3f(0, 1, 0), diffuse(floor_albedo));
    scene.rectangle(Vec3f(0.f, 2.f, 0.f), 3.f, 3.f, Vec3f(0, -1, 0), metal(alpha));
    scene.sphere(Vec3f(-0.6f, 0.5f, 0.f), 0.35f, frosted_glass(0.1));
    scene.sphere(Vec3f(0.f, 0.3f, 0.8f), 0.25f, glass());
    scene.sphere(Vec3f(0.7f, 0.4f, -0.6f), 0.3f, metal(0.2));
    scene.rectangle(Vec3f(0.5f, 1.f, 0.3f), 0.6f, 0.5f, Vec3f(0, 1, 0), diffuse(0.f), Color(lamp_radiance));
    if (light == Light::point) scene.point_light(Vec3f(-0.8f, 1.2f, 0.9f), Color(3.f));
    if (light == Light::sky) scene.environment(Color(0.5f));
    return scene;
}

bool same_bits(float a, float b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

// The chance that a guided direction is within a cone, by counting; and by integrating the density over the cone. Many kernels
// are narrow, so that a grid over the sphere would miss them.
Outcome cone_outcome(const GuideCell& cell, const Vec3f& from, const Vec3f& axis, float one_minus_cos,
                     std::uint64_t samples, std::uint64_t seed)
{
    TestRandom random(seed);
    MeanAndVariance counted, integrated;
    const Frame frame(axis);
    for (std::uint64_t i = 0; i < samples; ++i) {
        const float u_choice = random.next_1d();
        const auto guided = cell.sample(from, u_choice, random.next_2d());
        const bool inside = guided && length_squared(guided->direction - axis) <= 2.f * one_minus_cos;
        counted.add(inside ? 1.0 : 0.0);
        const Vec3f w = frame.to_world(square_to_uniform_cone(random.next_2d(), one_minus_cos));
        integrated.add(static_cast<double>(cell.pdf(from, w) / uniform_cone_pdf(one_minus_cos)));
    }
    return same_mean_outcome(counted, integrated, 1e-4);
}

} // namespace

TEST_CASE("guided directions follow their density", "[statistical][guide]")
{
    const Scene scene = balls().build();
    const CausticGuide guide = CausticGuide::learn(scene, CausticGuide::most_emitted, 0);
    REQUIRE(guide.is_on());
    const std::array<float, 3> widths{0.0005f, 0.01f, 0.2f};
    const int places = 8;
    TestRandom random(2);
    for (int place = 0; place < places;) {
        const Vec3f from(static_cast<float>(random.between(-2, 2)), 0.f,
                         static_cast<float>(random.between(-2, 2)));
        const GuideCell* const cell = guide.cell_at(from);
        if (!cell) continue;
        ++place;
        const float u_choice = random.next_1d();
        const auto guided = cell->sample(from, u_choice, random.next_2d());
        REQUIRE(guided);
        CHECK(same_bits(guided->pdf, cell->pdf(from, guided->direction)));
        CHECK(length(guided->direction) == Approx(1.f).epsilon(1e-6));
        for (const float width : widths)
            check_statistic(
                "from a floor, within " + std::to_string(width),
                [&](std::uint64_t n, std::uint64_t seed) {
                    return cone_outcome(*cell, from, guided->direction, width, n, seed);
                },
                100'000, sidak_level(significance, widths.size() * places));
        // And all of it.
        check_statistic(
            "from a floor, everywhere",
            [&](std::uint64_t n, std::uint64_t seed) {
                return cone_outcome(*cell, from, Vec3f(0, 1, 0), 2.f, n, seed);
            },
            100'000, sidak_level(significance, widths.size() * places));
    }
}

TEST_CASE("light from a lamp that a floor sees in a mirror has its closed form, with and without a guide",
          "[statistical][guide]")
{
    const Scene scene = mirrored_lamp();
    REQUIRE(CausticGuide::learn(scene, CausticGuide::most_emitted, 0).is_on());
    const PlacedLamp image{
        LampKind::rectangle,
        0.3,
        Vec3f(0.8f, 3.f, 0.3f),
        Vec3d(0, -1, 0),
        {Vec3f(0.7f, 3.f, 0.15f), Vec3f(0.9f, 3.f, 0.15f), Vec3f(0.9f, 3.f, 0.45f), Vec3f(0.7f, 3.f, 0.45f)}};
    const double expected = static_cast<double>(lamp_radiance * floor_albedo) *
                            form_factor(image, Vec3d(floor_point), Vec3d(0, 1, 0));
    for (const bool guided : {true, false})
        check_mean(
            guided ? "guided" : "not guided", expected,
            [&](std::uint64_t n, std::uint64_t seed) { return light_at_the_floor(scene, guided, n, seed); },
            guided ? 20'000 : 200'000, sidak_level(significance, 2));
}

TEST_CASE("light from a lamp behind a pane has its integral, with and without a guide",
          "[statistical][guide]")
{
    const Scene scene = lamp_behind_pane();
    REQUIRE(CausticGuide::learn(scene, CausticGuide::most_emitted, 0).is_on());
    for (const bool guided : {true, false})
        check_mean(
            guided ? "guided" : "not guided", light_behind_pane(),
            [&](std::uint64_t n, std::uint64_t seed) { return light_at_the_floor(scene, guided, n, seed); },
            guided ? 20'000 : 200'000, sidak_level(significance, 2));
}

TEST_CASE("a lamp in the way of guided directions counts once", "[statistical][guide]")
{
    // Half of the lamp in the mirror is behind another one, which emitter samples and the BSDF find.
    LittleScene scene = lamp_under(mirror());
    scene.rectangle(Vec3f(0.363f, 1.f, -0.033f), 0.06f, 0.2f, Vec3f(0, -1, 0), diffuse(0.f),
                    Color(lamp_radiance));
    const Scene lamps = scene.build();
    REQUIRE(CausticGuide::learn(lamps, CausticGuide::most_emitted, 0).is_on());
    check_same_mean(
        "two lamps",
        [&](std::uint64_t n, std::uint64_t seed) { return light_at_the_floor(lamps, true, n, seed); },
        [&](std::uint64_t n, std::uint64_t seed) { return light_at_the_floor(lamps, false, 10 * n, seed); },
        20'000, significance);
}

TEST_CASE("a guide makes caustics less noisy", "[statistical][guide]")
{
    // 20 samples in the place of one, at least; where the pane lets all light through it is about a hundred.
    for (const auto& make_scene : {mirrored_lamp, lamp_behind_pane}) {
        const Scene scene = make_scene();
        const double guided = light_at_the_floor(scene, true, 20'000, 1).variance();
        const double unguided = light_at_the_floor(scene, false, 200'000, 1).variance();
        CHECK(guided < 0.05 * unguided);
    }
}

TEST_CASE("a guide is a function of the scene, whatever the threads", "[statistical][guide]")
{
    const Scene scene = balls().build();
    const Scene same = balls().build();
    const CausticGuide one = CausticGuide::learn(scene, CausticGuide::most_emitted, 1),
                       many = CausticGuide::learn(same, CausticGuide::most_emitted, 3);
    CHECK(one.facts().arrived == many.facts().arrived);
    CHECK(one.facts().cells == many.facts().cells);
    TestRandom random(4);
    int guided = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3f point(static_cast<float>(random.between(-2, 2)), 0.f,
                          static_cast<float>(random.between(-2, 2)));
        const GuideCell* const a = one.cell_at(point);
        const GuideCell* const b = many.cell_at(point);
        REQUIRE((a == nullptr) == (b == nullptr));
        if (!a) continue;
        ++guided;
        const float u_choice = random.next_1d();
        const Vec2f u = random.next_2d();
        const auto from_a = a->sample(point, u_choice, u), from_b = b->sample(point, u_choice, u);
        REQUIRE(from_a.has_value() == from_b.has_value());
        if (!from_a) continue;
        REQUIRE(same_bits(from_a->pdf, from_b->pdf));
        REQUIRE(from_a->direction == from_b->direction);
    }
    CHECK(guided > 200);
}

TEST_CASE("there is no guide where there is nothing to guide", "[statistical][guide]")
{
    const auto facts = [](LittleScene& little, const ParamsBuilder& params) {
        const Scene scene = little.build();
        return guide_of(*make_integrator(params, scene));
    };
    const auto path_mis = [] { return integrator_params("path_mis"); };
    LittleScene lit = balls();
    const auto found = facts(lit, path_mis());
    REQUIRE(found);
    CHECK(found->cells > 0);
    CHECK(found->arrived > 1000);
    CHECK(found->emitted >= found->arrived);

    LittleScene off = balls(), direct = balls();
    CHECK_FALSE(facts(off, path_mis().boolean("guide", false)));
    CHECK_FALSE(facts(direct, path_mis().integer("maxDepth", 1)));
    LittleScene rough;
    rough.room(diffuse(0.5f)).sphere(Vec3f(0.f), 0.2f, diffuse(0.5f), Color(1.f));
    CHECK_FALSE(facts(rough, path_mis()));
    // No path meets a point.
    LittleScene point;
    point.room(diffuse(0.5f)).sphere(Vec3f(0.f), 0.2f, glass()).point_light(Vec3f(0.5f), Color(1.f));
    CHECK_FALSE(facts(point, path_mis()));
    // A mirror that no lamp sees.
    LittleScene hidden;
    hidden.room(diffuse(0.5f)).sphere(Vec3f(0.f), 0.2f, diffuse(0.5f), Color(1.f));
    hidden.sphere(Vec3f(3.f, 0.f, 0.f), 0.5f, mirror());
    const auto nothing = facts(hidden, path_mis());
    REQUIRE(nothing);
    CHECK(nothing->arrived == 0);
    CHECK(nothing->cells == 0);
}

// Under the glass ball: one bounce fewer than light takes through it, as many, and one more.
TEST_CASE("guided paths take no more bounces than others", "[statistical][guide]")
{
    const Scene scene = balls().build();
    const ChooseRay under_the_ball = rays_around(Vec3f(0.f, 1.f, 4.f), Vec3f(-0.6f, 0.f, 0.f), 0.2f);
    for (const int depth : {2, 3, 4}) {
        const auto params = [&](bool guided) {
            return integrator_params("path_mis").integer("maxDepth", depth).boolean("guide", guided);
        };
        const auto guided = make_integrator(params(true), scene);
        const auto unguided = make_integrator(params(false), scene);
        check_same_mean(
            fmt::format("depth {}", depth),
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *guided, under_the_ball, n, seed);
            },
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *unguided, under_the_ball, n, seed);
            },
            100000, sidak_level(significance, 3));
    }
}

// Emitter samples at links, and what links meet; of one link, two and any number.
TEST_CASE("light that shiny surfaces throw is the same with and without a guide", "[statistical][guide]")
{
    const ChooseRay among_the_balls = rays_around(Vec3f(0.f, 1.2f, 3.f), Vec3f(0.f, 0.f, 0.3f), 0.9f);
    const std::array<int, 4> depths{2, 3, 5, -1};
    const std::array<double, 2> alphas{0.03, 0.2};
    const double level = sidak_level(significance, 3 * depths.size() * alphas.size());
    for (const double alpha : alphas) {
        for (const Light light : {Light::lamp, Light::point, Light::sky}) {
            const Scene scene = under_metal(alpha, light).build();
            REQUIRE(CausticGuide::learn(scene, CausticGuide::most_emitted, 0).is_on());
            for (const int depth : depths) {
                const auto light_there = [&](bool guided, std::uint64_t n, std::uint64_t seed) {
                    const auto integrator = make_integrator(
                        integrator_params("path_mis").integer("maxDepth", depth).boolean("guide", guided),
                        scene);
                    return estimate(scene, *integrator, among_the_balls, n, seed);
                };
                check_same_mean(
                    fmt::format("alpha {}, light {}, depth {}", alpha, static_cast<int>(light), depth),
                    [&](std::uint64_t n, std::uint64_t seed) { return light_there(true, n, seed); },
                    [&](std::uint64_t n, std::uint64_t seed) { return light_there(false, 4 * n, seed); },
                    20'000, level);
            }
        }
    }
}

TEST_CASE("a guide makes light that metal throws less noisy", "[statistical][guide]")
{
    const Scene scene = lamp_under(metal(0.02)).build(); // nearly a mirror
    const double guided = light_at_the_floor(scene, true, 20'000, 1).variance();
    const double unguided = light_at_the_floor(scene, false, 200'000, 1).variance();
    CHECK(guided < 0.1 * unguided);
}

TEST_CASE("a surface is shiny if all that it scatters is glossy", "[unit][guide]")
{
    const auto principled = [](double metallic, double spec_trans, double sheen) {
        return ParamsBuilder("bsdf", "principled")
            .number("metallic", metallic)
            .number("specTrans", spec_trans)
            .number("sheen", sheen)
            .build<Principled, Bsdf>();
    };
    CHECK(are_shiny(metal(0.1)()->lobes()));
    CHECK(are_shiny(frosted_glass(0.1)()->lobes()));
    CHECK(are_shiny(principled(1.0, 0.0, 1.0)->lobes()));
    CHECK(are_shiny(principled(0.0, 1.0, 0.0)->lobes()));
    CHECK_FALSE(are_shiny(principled(0.0, 1.0, 0.5)->lobes()));
    CHECK_FALSE(are_shiny(principled(0.9, 0.0, 0.0)->lobes()));
    CHECK_FALSE(are_shiny(diffuse(0.5f)()->lobes()));
    CHECK_FALSE(are_shiny(mirror()()->lobes()));
    for (const MakeBsdf& make : {metal(0.1), frosted_glass(0.1), mirror(), glass()})
        CHECK(throw_caustics(make()->lobes()));
    CHECK_FALSE(throw_caustics(diffuse(0.5f)()->lobes()));
}
