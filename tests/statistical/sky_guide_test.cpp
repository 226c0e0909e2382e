// SPDX-License-Identifier: MIT

// Environments seen through windows: closed forms, equal means with and without what is learnt, and less noise with it.

#include "integrators/sky_guide.h"
#include "plumb/image/image.h"
#include "plumb/model/guide.h"
#include "support/catch.h"
#include "support/integrators.h"
#include "support/placed_lamp.h"
#include "support/samples.h"
#include "support/temp_directory.h"

namespace plumb {
class EnvironmentEmitter;
} // namespace plumb

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr float albedo = 0.5f;

// Where the window of room() is: z from -0.4 to 0.4, y from -0.2 to 0.6, at x = -1.
const std::vector<Vec3f> window_corners{
    {-1.f, -0.2f, -0.4f}, {-1.f, 0.6f, -0.4f}, {-1.f, 0.6f, 0.4f}, {-1.f, -0.2f, 0.4f}};

// The cube [-1, 1]^3 with a window, and a ball in it.
LittleScene room(float wall_albedo)
{
    LittleScene scene;
    const MakeBsdf wall = diffuse(wall_albedo);
    scene.rectangle(Vec3f(0, -1, 0), 2.f, 2.f, Vec3f(0, 1, 0), diffuse(albedo));
    scene.rectangle(Vec3f(0, 1, 0), 2.f, 2.f, Vec3f(0, -1, 0), wall);
    scene.rectangle(Vec3f(1, 0, 0), 2.f, 2.f, Vec3f(-1, 0, 0), wall);
    scene.rectangle(Vec3f(0, 0, -1), 2.f, 2.f, Vec3f(0, 0, 1), wall);
    scene.rectangle(Vec3f(0, 0, 1), 2.f, 2.f, Vec3f(0, 0, -1), wall);
    // Around the window; their width runs along z.
    scene.rectangle(Vec3f(-1, -0.6f, 0), 2.f, 0.8f, Vec3f(1, 0, 0), wall);
    scene.rectangle(Vec3f(-1, 0.8f, 0), 2.f, 0.4f, Vec3f(1, 0, 0), wall);
    scene.rectangle(Vec3f(-1, 0.2f, -0.7f), 0.6f, 0.8f, Vec3f(1, 0, 0), wall);
    scene.rectangle(Vec3f(-1, 0.2f, 0.7f), 0.6f, 0.8f, Vec3f(1, 0, 0), wall);
    return scene;
}

// A sky with a sun that shines into the window, or a gradient that repeats at the window's direction.
std::unique_ptr<Emitter> sky(bool with_sun)
{
    const TempDirectory directory;
    Image image(32, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) {
            const bool is_sun = with_sun && (x == 15 || x == 16) && y == 5;
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] = (is_sun ? 200.f : 0.f) + 0.2f +
                                       0.05f * static_cast<float>((x + c) % 8) + (y < 8 ? 1.f : 0.f);
        }
    write_image(directory / "sky.exr", image);
    return ParamsBuilder("emitter", "environment")
        .directory(directory.path())
        .string("filename", "sky.exr")
        .build<EnvironmentEmitter, Emitter>();
}

// Black, with holes that are too small to be seen: 0.6 of the light passes straight through.
MakeBsdf sheet()
{
    return [] {
        return Sample("<bsdf type='mask'><float name='opacity' value='0.4'/><bsdf type='diffuse'><color "
                      "name='albedo' "
                      "value='0 0 0'/></bsdf></bsdf>")
            .build(bsdf_types());
    };
}

// In the middle of the room, a ball of each kind.
LittleScene furnished(float wall_albedo)
{
    LittleScene scene = room(wall_albedo);
    scene.sphere(Vec3f(0.4f, -0.7f, -0.3f), 0.3f, diffuse(0.3f));
    scene.sphere(Vec3f(0.3f, -0.75f, 0.5f), 0.25f, glass());
    return scene;
}

ParamsBuilder path_mis(bool guided, int depth)
{
    return integrator_params("path_mis").integer("maxDepth", depth).boolean("guide", guided);
}

MeanAndVariance light(const Scene& scene, bool guided, int depth, const ChooseRay& ray, std::uint64_t samples,
                      std::uint64_t seed)
{
    return estimate(scene, *make_integrator(path_mis(guided, depth), scene), ray, samples, seed);
}

std::uint64_t windows_of(const Scene& scene)
{
    const auto facts = guide_of(*make_integrator(path_mis(true, 1), scene));
    return facts ? facts->windows : 0;
}

} // namespace

TEST_CASE("light of a sky of one colour through a window has its closed form", "[statistical][sky]")
{
    // With nothing in the window, and with a sheet that lets 0.6 of the light pass.
    for (const bool has_sheet : {false, true}) {
        LittleScene little = room(0.f);
        if (has_sheet) little.rectangle(Vec3f(-1.01f, 0.2f, 0.f), 40.f, 40.f, Vec3f(1, 0, 0), sheet());
        const Scene scene = little.environment(Color(2.f)).build();
        REQUIRE(windows_of(scene) > 5);
        PlacedLamp window;
        window.kind = LampKind::rectangle;
        window.center = Vec3f(-1.f, 0.2f, 0.f);
        window.normal = Vec3d(1, 0, 0);
        window.corners = window_corners;
        // Beside the window, below it, far away, and in a corner.
        const std::vector<Vec3f> places{
            {-0.6f, -1.f, 0.1f}, {-0.95f, -1.f, 0.f}, {0.9f, -1.f, 0.9f}, {0.3f, -1.f, -0.5f}};
        for (const Vec3f& place : places) {
            CAPTURE(has_sheet, place.x, place.z);
            const double expected = (has_sheet ? 1.2 : 2.0) * static_cast<double>(albedo) *
                                    form_factor(window, Vec3d(place), Vec3d(0, 1, 0));
            for (const bool guided : {true, false})
                check_mean(
                    guided ? "guided" : "not guided", expected,
                    [&](std::uint64_t n, std::uint64_t seed) {
                        return light(scene, guided, 1, ray_to(place + Vec3f(0.1f, 0.5f, -0.05f), place), n,
                                     seed);
                    },
                    guided ? 20'000 : 200'000, sidak_level(significance, 4 * places.size()), 1, 1e-5);
        }
    }
}

TEST_CASE("what is learnt of a sky changes no mean, and makes rooms less noisy", "[statistical][sky]")
{
    for (const bool with_sun : {true, false}) {
        LittleScene little = furnished(0.7f);
        const Scene scene = little.add_light(sky(with_sun)).build();
        REQUIRE(windows_of(scene) > 5);
        for (const int depth : {1, 4, -1}) {
            CAPTURE(with_sun, depth);
            // Floor, ball, and the far corner.
            const ChooseRay rays = rays_around(Vec3f(-0.2f, 0.3f, 0.f), Vec3f(0.3f, -0.7f, -0.1f), 0.5f);
            check_same_mean(
                "room",
                [&](std::uint64_t n, std::uint64_t seed) { return light(scene, true, depth, rays, n, seed); },
                [&](std::uint64_t n, std::uint64_t seed) {
                    return light(scene, false, depth, rays, 4 * n, seed);
                },
                40'000, sidak_level(significance, 6));
            // Of the sun's light, where it shines, choices by light alone find enough.
            CHECK(light(scene, true, depth, rays, 40'000, 3).variance() <
                  (with_sun ? 0.95 : 0.5) * light(scene, false, depth, rays, 160'000, 3).variance());
        }
    }
}

TEST_CASE("what is learnt of a sky is a function of scene and camera, whatever the threads",
          "[statistical][sky]")
{
    LittleScene little = furnished(0.7f);
    const Scene scene = little.add_light(sky(true)).build();
    const auto camera = camera_within(scene);
    const SkyGuide one = SkyGuide::learn(scene, *camera, 1), many = SkyGuide::learn(scene, *camera, 3);
    CHECK(one.windows() == many.windows());
    TestRandom random(5);
    int narrow = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto place = [&] { return static_cast<float>(random.between(-1.2, 1.2)); };
        const Vec3f position(place(), place(), place());
        const Vec3f normal = i % 7 == 0 ? Vec3f(0.f) : random.direction();
        const SkyView a = one.view_at(position, normal), b = many.view_at(position, normal);
        REQUIRE((a.left == b.left && a.right == b.right && a.top == b.top && a.bottom == b.bottom));
        REQUIRE(a.share == b.share);
        narrow += a.share < 0.3 ? 1 : 0;
    }
    CHECK(narrow > 500);
}

TEST_CASE("nothing is learnt where a sky is seen anyway, or there is not just one", "[statistical][sky]")
{
    const auto facts = [](LittleScene& little, const ParamsBuilder& params) {
        const Scene scene = little.build();
        return guide_of(*make_integrator(params, scene)).value_or(GuideFacts{});
    };
    LittleScene open;
    open.rectangle(Vec3f(0, -1, 0), 4.f, 4.f, Vec3f(0, 1, 0), diffuse(albedo)).environment(Color(1.f));
    const GuideFacts seen = facts(open, path_mis(true, -1));
    CHECK(seen.paths > 0);
    CHECK(seen.windows == 0);
    LittleScene none = room(0.5f), off = room(0.5f), two = room(0.5f), black = room(0.5f);
    none.sphere(Vec3f(0.f), 0.2f, diffuse(0.f), Color(1.f));
    CHECK(facts(none, path_mis(true, -1)).paths == 0);
    CHECK(facts(off.environment(Color(1.f)), path_mis(false, -1)).paths == 0);
    CHECK(facts(two.environment(Color(1.f)).environment(Color(2.f)), path_mis(true, -1)).paths == 0);
    CHECK(facts(black.environment(Color(0.f)), path_mis(true, -1)).windows == 0);
}
