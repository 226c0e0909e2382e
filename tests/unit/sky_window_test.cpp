// SPDX-License-Identifier: MIT

#include "integrators/sky_window.h"
#include "plumb/sampling/sampling.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"

namespace plumb {
class EnvironmentEmitter;
}

using namespace plumb;
using test::TestRandom;

namespace {

std::unique_ptr<Emitter> white_sky()
{
    return test::ParamsBuilder("emitter", "environment").build<EnvironmentEmitter, Emitter>();
}

// Rays to a window of size 1 in front of a cell, as many as see it of a uniform sky.
std::vector<SkyRay> rays_through(const SkyMap& map, const Frame& view, float distance, float cell,
                                 std::size_t count, std::uint64_t seed)
{
    TestRandom random(seed);
    std::vector<SkyRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const auto spread = [&](float by) { return static_cast<float>(random.between(-0.5, 0.5)) * by; };
        const Vec3f position(spread(cell), spread(cell), spread(cell));
        const Vec3f target = view.to_world(Vec3f(spread(1.f), spread(1.f), distance));
        rays.push_back({position, map.place_of(normalize(target - position)), 1.0});
    }
    return rays;
}

} // namespace

TEST_CASE("a window follows the place that it is seen from", "[unit][sky]")
{
    const auto sky = white_sky();
    const SkyMap& map = *sky->sky_map();
    TestRandom random(3);
    for (int i = 0; i < 40; ++i) {
        // Not around the map's poles, where no rectangle is small.
        Vec3f towards = random.direction();
        towards.y *= 0.5f;
        const Frame view(normalize(towards));
        const float cell = static_cast<float>(random.between(0.0, 1.5));
        const std::vector<SkyRay> learnt =
            rays_through(map, view, 2.5f, cell, 400, 10 + static_cast<std::uint64_t>(i));
        const auto window = fit_window(map, learnt);
        CAPTURE(i, cell, towards.x, towards.y, towards.z);
        REQUIRE(window);
        int seen = 0;
        double share = 0.0;
        const std::vector<SkyRay> others =
            rays_through(map, view, 2.5f, cell, 1000, 1000 + static_cast<std::uint64_t>(i));
        for (const SkyRay& ray : others) {
            const SkyView shown = map.view(window->seen_from(ray.position));
            seen += map.shows(shown, ray.place) ? 1 : 0;
            share += shown.share / static_cast<double>(others.size());
        }
        CHECK(seen > 940);
        // The window itself has 0.15 sr; a cell as large as it blurs it.
        CHECK(share * 4.0 * pi_d < 0.15 * (2.5 + 3.0 * static_cast<double>(cell)));
    }
}

TEST_CASE("there is no window where most of the sky is seen, or too little is known", "[unit][sky]")
{
    const auto sky = white_sky();
    const SkyMap& map = *sky->sky_map();
    TestRandom random(4);
    std::vector<SkyRay> rays;
    for (int i = 0; i < 3000; ++i)
        rays.push_back({random.direction(), map.place_of(random.direction()), 1.0});
    CHECK_FALSE(fit_window(map, rays));
    CHECK_FALSE(fit_window(map, std::span(rays).first(0)));
    const std::vector<SkyRay> few = rays_through(map, Frame(Vec3f(1, 0, 0)), 2.f, 0.1f, 7, 1);
    CHECK_FALSE(fit_window(map, few));
    // One that differs from the others is left outside.
    std::vector<SkyRay> most = rays_through(map, Frame(Vec3f(1, 0, 0)), 2.f, 0.1f, 500, 1);
    most.push_back({Vec3f(0.f), map.place_of(Vec3f(-1.f, 0.f, 0.f)), 1.0});
    const auto window = fit_window(map, most);
    REQUIRE(window);
    CHECK(map.view(window->seen_from(Vec3f(0.f))).share < 0.05);
}
