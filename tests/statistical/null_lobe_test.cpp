// SPDX-License-Identifier: MIT

// Surfaces that light passes straight through (masks, `null`, blends of them), by every integrator and under every kind of
// light, against closed forms and against the values that Mitsuba 3.9.1 gives (its max_depth counts one more).

#include "support/catch.h"
#include "support/integrators.h"
#include "support/samples.h"

using namespace plumb;
using namespace plumb::test;

namespace {

MakeBsdf from_text(const std::string& xml)
{
    return [xml] { return Sample(xml).build(bsdf_types()); };
}

MakeBsdf mask(const std::string& opacity, const std::string& child)
{
    return from_text("<bsdf type=\"mask\"><float name=\"opacity\" value=\"" + opacity + "\"/>" + child +
                     "</bsdf>\n");
}

const std::string black = "<bsdf type=\"diffuse\"><color name=\"albedo\" value=\"0 0 0\"/></bsdf>";
const std::string white = "<bsdf type=\"diffuse\"><color name=\"albedo\" value=\"1 1 1\"/></bsdf>";
const std::string white_on_both_sides = "<bsdf type=\"twosided\">" + white + "</bsdf>";
const Vec3f up(0, 1, 0);

// A sheet at that height which lets 0.7 of the light pass.
void add_sheet(LittleScene& scene, float height, float size = 40.f)
{
    scene.rectangle(Vec3f(0, height, 0), size, size, up, mask("0.3", black));
}

enum class Light { ball, panel, point, sun, sky };

// A white floor under one light, 4 above it.
void add_floor_and_light(LittleScene& scene, Light light)
{
    scene.rectangle(Vec3f(0.f), 3.f, 3.f, up, diffuse(1.f));
    switch (light) {
    case Light::ball: scene.sphere(Vec3f(0, 4, 0), 0.3f, diffuse(0.f), Color(10.f)); break;
    case Light::panel: scene.rectangle(Vec3f(0, 4, 0), 0.5f, 0.5f, -up, diffuse(0.f), Color(10.f)); break;
    case Light::point: scene.point_light(Vec3f(0, 4, 0), Color(10.f)); break;
    case Light::sun: scene.directional_light(up, Color(2.f)); break;
    case Light::sky: scene.environment(Color(1.f)); break;
    }
}

std::vector<NamedParams> integrators_of_direct_light(Light light)
{
    std::vector<NamedParams> result = path_tracers(1);
    for (NamedParams& one : direct_light_integrators()) {
        const bool by_solid_angle = one.name.find("solid") != std::string::npos;
        if (!by_solid_angle || light == Light::ball || light == Light::panel)
            result.push_back(std::move(one));
    }
    result.push_back({"whitted", integrator_params("whitted")});
    return result;
}

// The luminance along a ray in both scenes; the second's times a factor.
void check_factor(const std::string& name, const Scene& through, const Scene& open, const ChooseRay& ray,
                  const ParamsBuilder& params, double factor, double level)
{
    const auto a = make_integrator(params, through), b = make_integrator(params, open);
    check_statistic(
        name,
        [&](std::uint64_t n, std::uint64_t seed) {
            MeanAndVariance scaled;
            const auto sampler = independent_sampler();
            const MeanAndVariance first = estimate(through, *a, ray, n, seed);
            Tracer tracer(open);
            for (std::uint64_t i = 0; i < n; ++i) {
                sampler->start(seed + 1, {0, 0}, i);
                scaled.add(factor *
                           static_cast<double>(luminance(b->radiance(tracer, *sampler, ray(*sampler)))));
            }
            return same_mean_outcome(first, scaled, 1e-3);
        },
        5'000, level);
}

} // namespace

TEST_CASE("sheets attenuate every kind of light, before and after the floor", "[statistical][null]")
{
    for (const Light light : {Light::ball, Light::panel, Light::point, Light::sun, Light::sky}) {
        LittleScene with, without;
        add_floor_and_light(with, light);
        add_floor_and_light(without, light);
        const float size = light == Light::sky ? 4000.f : 40.f;
        add_sheet(with, 1.f, size);
        add_sheet(with, 2.f, size);
        const Scene through = with.build(), open = without.build();
        REQUIRE(through.has_null_surfaces());
        REQUIRE_FALSE(open.has_null_surfaces());
        const auto integrators = integrators_of_direct_light(light);
        const double level = sidak_level(significance, 5 * 2 * integrators.size());
        for (const NamedParams& named : integrators) {
            const std::string name = named.name + ", light " + std::to_string(static_cast<int>(light));
            // Under both sheets: the light passes two. Between them: the light two, and what is seen one.
            check_factor(name, through, open, rays_around(Vec3f(0.3f, 0.6f, 0), Vec3f(0.f), 0.2f),
                         named.params, 0.7 * 0.7, level);
            check_factor(name + ", from above", through, open,
                         rays_around(Vec3f(0.6f, 1.8f, 0), Vec3f(0.f), 0.2f), named.params, 0.7 * 0.7 * 0.7,
                         level);
        }
    }
}

TEST_CASE("simple, ao and av see through sheets", "[statistical][null]")
{
    LittleScene with, without;
    add_floor_and_light(with, Light::point);
    add_floor_and_light(without, Light::point);
    add_sheet(with, 1.f, 4000.f);
    const Scene through = with.build(), open = without.build();
    const auto from_below = rays_around(Vec3f(0.3f, 0.6f, 0), Vec3f(0.f), 0.2f);
    const auto from_above = rays_around(Vec3f(0.6f, 1.8f, 0), Vec3f(0.f), 0.2f);
    const auto simple = integrator_params("simple");
    const auto own =
        integrator_params("simple").point("position", Vec3f(0, 4, 0)).color("energy", Color(9.f));
    check_factor("simple", through, open, from_below, simple, 0.7, 1e-3);
    check_factor("simple", through, open, from_above, simple, 0.49, 1e-3);
    check_factor("simple, own light", through, open, from_below, own, 0.7, 1e-3);
    check_factor("ao", through, open, from_below, integrator_params("ao"), 0.7, 1e-3);
    // The sheet's part is open, the floor's is seen through it twice.
    const auto mean = [&](const ParamsBuilder& params, const ChooseRay& ray) {
        return estimate(through, *make_integrator(params, through), ray, 20'000, 5).mean();
    };
    CHECK(mean(integrator_params("ao"), from_above) == Approx(0.3 * 1.0 + 0.7 * 0.7).epsilon(0.02));
    CHECK(mean(integrator_params("av").number("length", 0.5), from_above) == Approx(1.0));
    // Within 2 of the floor, half of the directions meet the sheet, at height 1.
    CHECK(mean(integrator_params("av").number("length", 2.0), from_below) ==
          Approx(0.5 + 0.5 * 0.7).epsilon(0.02));
}

TEST_CASE("masks, null surfaces and blends leave a furnace as it is", "[statistical][null]")
{
    // Closed, all walls of emission 1 and albedo 0.5: radiance 2 everywhere, whatever is in it that absorbs nothing.
    LittleScene little;
    little.room(diffuse(0.5f), Color(1.f));
    little.sphere(Vec3f(0.2f, 0, 0), 0.4f, mask("0.6", white_on_both_sides));
    little.rectangle(Vec3f(-0.5f, 0, 0.1f), 1.f, 1.2f, Vec3f(1, 0.2f, 0.3f),
                     mask("0.4", white_on_both_sides));
    little.sphere(Vec3f(0, 0.1f, 0), 0.7f, from_text("<bsdf type=\"null\"/>\n"));
    little.rectangle(
        Vec3f(0, -0.6f, 0), 1.f, 1.f, up,
        from_text("<bsdf type=\"twosided\"><bsdf type=\"blend\"><float name=\"weight\" value=\"0.3\"/>"
                  "<bsdf type=\"mirror\"/>" +
                  white + "</bsdf></bsdf>\n"));
    little.rectangle(
        Vec3f(0, 0.6f, 0), 0.7f, 0.7f, up,
        from_text("<bsdf type=\"blend\"><float name=\"weight\" value=\"0.7\"/><bsdf type=\"null\"/>" +
                  white_on_both_sides + "</bsdf>\n"));
    const Scene scene = little.build();
    const auto tracers = path_tracers(-1, false);
    for (const NamedParams& named : tracers) {
        const auto integrator = make_integrator(named.params, scene);
        check_mean(
            named.name, 2.0,
            [&](std::uint64_t n, std::uint64_t seed) {
                return estimate(scene, *integrator, rays_around(Vec3f(0.9f, 0.3f, 0.5f), Vec3f(0.f), 0.6f), n,
                                seed);
            },
            20'000, sidak_level(significance, tracers.size()), 1, 1e-4);
    }
}

TEST_CASE("an emitter that light passes counts, and so does what is behind it", "[statistical][null]")
{
    // A panel of radiance 3 that lets 0.4 of the light pass, below one of radiance 10, above a white floor.
    LittleScene little;
    little.rectangle(Vec3f(0.f), 3.f, 3.f, up, diffuse(1.f));
    little.rectangle(Vec3f(0, 2, 0), 0.8f, 0.8f, -up, mask("0.6", black), Color(3.f));
    little.rectangle(Vec3f(0, 4, 0), 1.f, 1.f, -up, diffuse(0.f), Color(10.f));
    const Scene scene = little.build();
    std::vector<NamedParams> integrators = path_tracers(1);
    for (NamedParams& one : direct_light_integrators()) integrators.push_back(std::move(one));
    const ChooseRay ray = ray_to(Vec3f(1.f, 1.f, 0), Vec3f(0.f));
    // Seen from the origin, the lower panel covers the upper one: form factors of squares above their middle.
    const auto square = [](double half, double height) {
        const double x = half / height, s = std::sqrt(1.0 + x * x);
        return 4.0 / pi_d * x / s * std::atan(x / s);
    };
    const double expected = 3.0 * square(0.4, 2.0) + 0.4 * 10.0 * square(0.5, 4.0);
    for (const NamedParams& named : integrators) {
        const auto integrator = make_integrator(named.params, scene);
        check_mean(
            named.name, expected,
            [&](std::uint64_t n, std::uint64_t seed) { return estimate(scene, *integrator, ray, n, seed); },
            20'000, sidak_level(significance, integrators.size()), 1, 1e-3);
    }
}

TEST_CASE("passes count as bounces where the integrator says so", "[statistical][null]")
{
    // A lamp behind a mask of opacity 0: Mitsuba's mask_depth, null_depth and null_depth2.
    LittleScene behind;
    behind.rectangle(Vec3f(0, -1, 0), 9.f, 9.f, up, diffuse(0.f), Color(5.f));
    behind.rectangle(Vec3f(0.f), 2.f, 2.f, up, from_text("<bsdf type=\"null\"/>\n"));
    const Scene lamp = behind.build();
    const auto seen = [&](const char* type, int depth, bool counts) {
        const auto params = integrator_params(type).integer("maxDepth", depth).boolean("countPasses", counts);
        return estimate(lamp, *make_integrator(params, lamp), ray_to(Vec3f(0, 3, 0), Vec3f(0.f)), 8, 1)
            .mean();
    };
    for (const char* type : {"path", "path_nee", "path_mis", "path_mats"}) {
        CHECK(seen(type, 0, true) == 0.0);
        CHECK(seen(type, 1, true) == Approx(5.0));
        CHECK(seen(type, 0, false) == Approx(5.0));
    }

    // Mitsuba's mask_shadow_area (0.0398) and mask_shadow_area_depth2 (0).
    LittleScene little;
    add_floor_and_light(little, Light::ball);
    add_sheet(little, 2.f);
    const Scene scene = little.build();
    const ChooseRay ray = ray_to(Vec3f(0, 1.9f, 0), Vec3f(0.f));
    const double open = 10.0 * sqr(0.3 / 4.0);
    for (const char* type : {"path_nee", "path_mis", "path"}) {
        const auto params = [&](int depth, bool counts) {
            return integrator_params(type).integer("maxDepth", depth).boolean("countPasses", counts);
        };
        const auto dark = make_integrator(params(1, true), scene);
        CHECK(estimate(scene, *dark, ray, 4000, 1).mean() == 0.0);
        for (const auto& one : {params(2, true), params(1, false), params(-1, true)}) {
            const auto integrator = make_integrator(one, scene);
            check_mean(
                one.text(), 0.7 * open,
                [&](std::uint64_t n, std::uint64_t seed) {
                    return estimate(scene, *integrator, ray, n, seed);
                },
                40'000, sidak_level(significance, 9), 1, 1e-3);
        }
    }
}

TEST_CASE("a blend is the weighted sum, in the order of the file", "[unit][bsdf][null]")
{
    const auto blend =
        Sample("<bsdf type=\"blend\"><float name=\"weight\" value=\"0.3\"/>"
               "<bsdf type=\"diffuse\"><color name=\"albedo\" value=\"1 0 0\"/></bsdf>"
               "<bsdf type=\"diffuse\"><color name=\"albedo\" value=\"0 1 0\"/></bsdf></bsdf>\n")
            .build(bsdf_types());
    const BsdfValue value = blend->evaluate({}, Vec3f(0, 0, 1), Vec3f(0, 0, 1));
    CHECK(value.f_cos.r == Approx(0.222817f).epsilon(1e-5)); // Mitsuba's bsdf_blendbsdf_03_d
    CHECK(value.f_cos.g == Approx(0.095493f).epsilon(1e-5));
    CHECK(value.pdf == Approx(inv_pi));
}

TEST_CASE("a mask passes 1 - opacity and leaves the rest to its BSDF", "[unit][bsdf][null]")
{
    const auto made = mask("0.3", white)();
    const SurfacePoint at;
    CHECK(made->opacity(at) == 0.3f);
    const Vec3f wi(0.6f, 0, 0.8f);
    const auto through = made->sample(at, wi, 0.31f, Vec2f(0.5f));
    REQUIRE(through);
    CHECK(through->is_pass());
    CHECK(through->is_delta());
    CHECK(through->wo == -wi);
    CHECK(through->weight == Color(1.f));
    CHECK(through->pdf == Approx(0.7f));
    const auto reflected = made->sample(at, wi, 0.29f, Vec2f(0.5f));
    REQUIRE(reflected);
    CHECK(reflected->lobe == Lobe::diffuse_reflection);
    CHECK(made->evaluate(at, wi, reflected->wo).pdf == Approx(reflected->pdf));
    const auto from_behind = made->sample(at, -wi, 0.9f, Vec2f(0.5f));
    REQUIRE(from_behind);
    CHECK(from_behind->wo == wi);
}
