// SPDX-License-Identifier: MIT

// All path tracers have the same mean on every scene: the three classical ones, and the configurable one in both
// modes with roulette.

#include "support/catch.h"
#include "support/integrators.h"

namespace plumb {
class Diffuse;
class Microfacet;
class Phong;
class RoughConductor;
class RoughDielectric;
class RoughSubstrate;
class Plastic;
class RoughPlastic;
class ThinDielectric;
class Principled;
class PrincipledThin;
} // namespace plumb

using namespace plumb;
using namespace plumb::test;

namespace {

template <class T>
MakeBsdf make(const ParamsBuilder& params)
{
    return [params] { return params.build<T, Bsdf>(); };
}

ParamsBuilder bsdf(const std::string& type)
{
    return ParamsBuilder("bsdf", type);
}

// A room of grey and coloured walls, a lamp below its ceiling and a lamp ball. No lamp touches a surface: next to
// one the variance of sampling by area is infinite.
void add_lit_room(LittleScene& scene)
{
    scene.rectangle(Vec3f(-1, 0, 0), 2.f, 2.f, Vec3f(1, 0, 0), diffuse(Color(0.6f, 0.1f, 0.1f)));
    scene.rectangle(Vec3f(1, 0, 0), 2.f, 2.f, Vec3f(-1, 0, 0), diffuse(Color(0.1f, 0.6f, 0.1f)));
    for (const Vec3f& n : {Vec3f(0, 1, 0), Vec3f(0, -1, 0), Vec3f(0, 0, 1), Vec3f(0, 0, -1)})
        scene.rectangle(-n, 2.f, 2.f, n, diffuse(0.7f));
    scene.rectangle(Vec3f(0.f, 0.9f, 0.f), 0.9f, 0.9f, Vec3f(0, -1, 0), diffuse(0.5f), Color(8.f, 7.f, 6.f));
    scene.sphere(Vec3f(0.5f, 0.2f, -0.5f), 0.15f, diffuse(0.5f), Color(5.f, 9.f, 12.f));
}

void add_balls(LittleScene& scene, const MakeBsdf& left, const MakeBsdf& right)
{
    scene.sphere(Vec3f(-0.4f, -0.6f, -0.2f), 0.39f, left);
    scene.sphere(Vec3f(0.4f, -0.65f, 0.1f), 0.34f, right);
}

// The floor, both balls, and what is around them.
const ChooseRay overview = rays_around(Vec3f(0.f, 0.f, 0.95f), Vec3f(0.f, -0.6f, 0.f), 0.5f);

struct Setting {
    std::string name;
    std::function<void(LittleScene&)> fill;
};

std::vector<Setting> settings()
{
    const MakeBsdf metal = make<RoughConductor>(bsdf("roughconductor").number("alpha", 0.25));
    const MakeBsdf varnish = make<RoughSubstrate>(
        bsdf("roughsubstrate").number("alpha", 0.2).color("kd", Color(0.5f, 0.2f, 0.1f)));
    const MakeBsdf blend = make<Microfacet>(bsdf("microfacet").number("alpha", 0.3).color("kd", Color(0.3f)));
    const MakeBsdf phong = make<Phong>(bsdf("phong")
                                           .color("diffuse-coefficients", Color(0.3f))
                                           .color("specular-coefficients", Color(0.5f))
                                           .integer("exponent", 12));
    const MakeBsdf frosted = make<RoughDielectric>(bsdf("roughdielectric").number("alpha", 0.3));
    const MakeBsdf painted = make<Diffuse>(
        bsdf("diffuse").texture("albedo", two_tone_texture(Color(0.8f, 0.8f, 0.1f), Color(0.1f))));
    const auto room_with = [](const MakeBsdf& left, const MakeBsdf& right) {
        return [=](LittleScene& scene) {
            add_lit_room(scene);
            add_balls(scene, left, right);
        };
    };
    const auto point_lights = [=](LittleScene& scene) {
        room_with(glass(), metal)(scene);
        scene.point_light(Vec3f(0.2f, 0.5f, 0.2f), Color(0.5f));
        scene.point_light(Vec3f(-0.5f, 0.5f, 0.4f), Color(0.1f, 0.2f, 0.3f));
    };
    const auto outdoors = [=](LittleScene& scene) {
        scene.rectangle(Vec3f(0, -1, 0), 8.f, 8.f, Vec3f(0, 1, 0), diffuse(0.6f));
        scene.sphere(Vec3f(0.f, 0.8f, -0.5f), 0.2f, diffuse(0.f), Color(20.f));
        scene.environment(Color(0.5f, 0.7f, 1.f)).directional_light(Vec3f(1, 1, 0.5f), Color(1.5f));
        add_balls(scene, frosted, metal);
    };
    const MakeBsdf gold = make<RoughConductor>(bsdf("roughconductor")
                                                   .string("material", "Au")
                                                   .string("distribution", "ggx")
                                                   .number("alphaU", 0.2)
                                                   .number("alphaV", 0.5));
    const MakeBsdf plastic =
        make<Plastic>(bsdf("plastic").color("diffuseReflectance", Color(0.2f, 0.5f, 0.1f)));
    const MakeBsdf rough_plastic = make<RoughPlastic>(
        bsdf("roughplastic").number("alpha", 0.2).string("distribution", "ggx").boolean("nonlinear", true));
    const MakeBsdf pane = make<ThinDielectric>(bsdf("thindielectric").number("intIOR", 1.8));
    const MakeBsdf lacquer = make<Principled>(bsdf("principled")
                                                  .color("baseColor", Color(0.7f, 0.3f, 0.1f))
                                                  .number("roughness", 0.6)
                                                  .number("metallic", 0.3)
                                                  .number("anisotropic", 0.5)
                                                  .number("specTrans", 0.5)
                                                  .number("sheen", 0.5)
                                                  .number("clearcoat", 0.5));
    const MakeBsdf leaf = make<PrincipledThin>(bsdf("principledthin")
                                                   .color("baseColor", Color(0.3f, 0.6f, 0.2f))
                                                   .number("specTrans", 0.4)
                                                   .number("diffTrans", 0.8));
    return {
        {"diffuse", room_with(diffuse(0.5f), painted)},
        {"anisotropic gold and plastic", room_with(gold, plastic)},
        {"rough plastic and a thin pane", room_with(rough_plastic, pane)},
        {"principled and principled thin", room_with(lacquer, leaf)},
        {"glossy", room_with(metal, varnish)},
        {"glossy and phong", room_with(blend, phong)},
        {"caustics", room_with(glass(), mirror())},
        {"frosted glass", room_with(frosted, diffuse(0.5f))},
        {"point lights", point_lights},
        {"outdoors", outdoors},
    };
}

void check_agreement(const Setting& setting, bool absorb, std::uint64_t samples, std::size_t tests)
{
    LittleScene little;
    setting.fill(little);
    if (absorb) little.absorbing_emitters();
    const Scene scene = little.build();
    const auto reference = make_integrator(integrator_params("path_mis"), scene);
    for (const NamedParams& named : path_tracers(-1)) {
        if (named.name == "path_mis") continue;
        const auto other = make_integrator(named.params, scene);
        check_same_mean(
            setting.name + (absorb ? ", absorbing emitters: " : ": ") + named.name + " and path_mis",
            [&](std::uint64_t n, std::uint64_t seed) { return estimate(scene, *other, overview, n, seed); },
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *reference, overview, n, seed);
            },
            samples, sidak_level(significance, tests));
    }
}

} // namespace

TEST_CASE("all path tracers agree on small scenes of every kind", "[statistical][agreement]")
{
    const std::vector<Setting> all = settings();
    for (std::size_t i = 0; i < all.size(); ++i) check_agreement(all[i], i % 2 == 1, 10000, 10 * all.size());
}

TEST_CASE("all path tracers agree within a fraction of a percent", "[statistical][agreement][slow]")
{
    const std::vector<Setting> all = settings();
    for (const Setting& setting : all)
        for (const bool absorb : {false, true}) check_agreement(setting, absorb, 50000, 20 * all.size());
}

TEST_CASE("explicit solid-angle sampling agrees with the other measures", "[statistical][agreement]")
{
    // Sphere lights only.
    const Scene scene = LittleScene()
                            .room(diffuse(0.5f))
                            .sphere(Vec3f(0.f, 0.6f, 0.f), 0.2f, diffuse(0.5f), Color(10.f))
                            .sphere(Vec3f(0.4f, -0.2f, -0.4f), 0.1f, diffuse(0.5f), Color(20.f, 5.f, 1.f))
                            .build();
    const auto reference = make_integrator(integrator_params("path_mis"), scene);
    for (const char* measure : {"solid-angle", "area", "hemisphere", "none"}) {
        const auto other = make_integrator(
            configured_path(true, "russian-roulette", 0.3).string("direct-measure", measure), scene);
        check_same_mean(
            measure,
            [&](std::uint64_t n, std::uint64_t seed) { return estimate(scene, *other, overview, n, seed); },
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *reference, overview, n, seed);
            },
            20000, sidak_level(significance, 4));
    }
}

TEST_CASE("every bounce limit has the same mean in all path tracers", "[statistical][agreement]")
{
    const std::vector<int> limits{0, 1, 2, 4};
    LittleScene little;
    add_lit_room(little);
    add_balls(little, glass(), diffuse(0.5f));
    const Scene scene = little.build();
    for (const int limit : limits) {
        const std::vector<NamedParams> tracers = path_tracers(limit);
        const auto reference = make_integrator(tracers.front().params, scene);
        for (std::size_t i = 1; i < tracers.size(); ++i) {
            const auto other = make_integrator(tracers[i].params, scene);
            check_same_mean(
                tracers[i].name + " with maxDepth " + std::to_string(limit),
                [&](std::uint64_t n, std::uint64_t seed) {
                    return estimate(scene, *other, overview, n, seed);
                },
                [&](std::uint64_t n, std::uint64_t seed) {
                    return estimate(scene, *reference, overview, n, seed);
                },
                10000, sidak_level(significance, 10 * limits.size()));
        }
    }
}
