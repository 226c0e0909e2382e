// SPDX-License-Identifier: MIT

// The law of repeatable images: the film depends on scene, settings, seed and the set of samples taken, and on nothing
// else. Cases are drawn at random, from another seed in each run; a failure prints the seed, and with PLUMB_TEST_SEED set to
// it the same cases are drawn again.

#include "base/temporary_file.h"
#include "plumb/model/guide.h"
#include "plumb/render/state_file.h"
#include "support/catch.h"
#include "support/random.h"
#include "support/scene_text.h"

#include <atomic>
#include <cstdlib>
#include <random>

using namespace plumb;
using test::TestRandom;

namespace {

constexpr int width = 37;
constexpr int height = 29;

std::string scene_with(const std::string& integrator, const std::string& sampler, const std::string& filter,
                       const std::string& things)
{
    return "<scene dialect='plumb'><integrator type='" + integrator + "'/><sampler type='" + sampler +
           "'/><camera type='perspective'>" +
           "<integer name='width' value='37'/><integer name='height' value='29'/><float name='fov' "
           "value='50'/>" +
           "<float name='lensRadius' value='0.05'/><float name='focalDistance' value='4'/><transform "
           "name='toWorld'>" +
           "<lookat origin='0,1.5,5' target='0,0.6,0' up='0,1,0'/></transform><rfilter type='" + filter +
           "'/></camera><mesh type='rectangle'><vector name='normal' value='0,1,0'/><float name='width' "
           "value='9'/>" +
           "<float name='height' value='9'/><bsdf type='diffuse'/></mesh>" + things + "</scene>";
}

const std::string lamp =
    "<mesh type='rectangle'><point name='center' value='0,3,0'/><vector name='normal' "
    "value='0,-1,0'/><emitter type='area'><color name='radiance' value='9,8,7'/></emitter></mesh>";
const std::string ball = "<mesh type='sphere'><point name='center' value='-0.5,0.7,0'/><float name='radius' "
                         "value='0.7'/>";

std::string wall(const std::string& center, const std::string& normal, const std::string& size)
{
    return "<mesh type='rectangle'><point name='center' value='" + center +
           "'/><vector name='normal' value='" + normal + "'/><float name='width' value='" + size +
           "'/><float name='height' value='" + size + "'/></mesh>";
}

// Over the floor, open above one of its walls.
const std::string room = wall("0,3,0", "0,-1,0", "9") + wall("4.5,3,0", "-1,0,0", "9") +
                         wall("0,3,4.6", "0,0,-1", "9") + wall("0,3,-4.5", "0,0,1", "9") +
                         wall("-4.5,-2,0", "1,0,0", "9") +
                         "<emitter type='environment'><color name='radiance' value='1,2,3'/></emitter>";

// Glass with a filter of negative lobes; gloss and a point light; samples so bright that their squares are kept apart;
// instances; a room under a sky.
const std::string scenes[] = {
    scene_with("path_mis", "sobol", "mitchell", lamp + ball + "<bsdf type='dielectric'/></mesh>"),
    scene_with("path_nee", "independent", "gaussian",
               lamp + ball +
                   "<bsdf type='roughconductor'/></mesh><emitter type='pointlight'><point name='position' "
                   "value='-3,3,2'/><color name='radiance' value='9,9,9'/></emitter>"),
    scene_with(
        "path", "stratified", "tent",
        ball + "<bsdf type='mirror'/></mesh><mesh type='sphere'><point name='center' value='1,1,1'/><float "
               "name='radius' value='0.5'/><emitter type='area'><color name='radiance' "
               "value='900000,8,7'/></emitter></mesh>"),
    scene_with("path_mis", "independent", "gaussian",
               lamp + "<shape type='group' id='pair'>" + ball + "<bsdf type='roughconductor'/></mesh>" +
                   "<shape type='disk'><bsdf type='diffuse'/></shape></shape>" +
                   "<shape type='instance'><ref id='pair'/></shape><shape type='instance'><ref id='pair'/>"
                   "<transform name='toWorld'><matrix value='-1 0.3 0 1.2 0 0.5 0 0.1 0.2 0 0.7 0.5 0 0 0 "
                   "1'/></transform></shape>"),
    scene_with("path_mis", "sobol", "box", room + ball + "<bsdf type='roughconductor'/></mesh>"),
};

int below(TestRandom& random, int limit)
{
    return static_cast<int>(random.next_double() * limit);
}

bool same_bits(const RenderState& a, const RenderState& b)
{
    const PixelRect& window = a.film.window();
    if (window != b.film.window() || a.film.plans() != b.film.plans() || a.taken != b.taken ||
        a.rays.total() != b.rays.total())
        return false;
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x)
            if (a.film.words({x, y}) != b.film.words({x, y}) ||
                a.film.large_words({x, y}) != b.film.large_words({x, y}) ||
                (a.film.plans() == Plans::kept && a.film.plan({x, y}) != b.film.plan({x, y})))
                return false;
    return true;
}

RenderState through_a_file(RenderState state, const TempDirectory& directory)
{
    TemporaryFile file(directory / "state.exr");
    file.write(std::span<const unsigned char>(encode_state(state, {width, height}, {})));
    file.take_place();
    return read_state(directory / "state.exr").state;
}

// Takes the samples with threads, tiles and interruptions of its own; each interruption may go through a file.
RenderState take(const RenderJob& job, RenderOptions options, const SampleSet& wanted, TestRandom& random,
                 const TempDirectory& directory)
{
    const Vec2i size = job.camera->resolution();
    const Plans plans = options.adaptive ? Plans::kept : Plans::none;
    RenderState state{Film(render_window(job, options), size.x, size.y, {}, plans), {}, {}, {}};
    for (bool done = false; !done;) {
        options.threads = 1 + below(random, 4);
        options.tile_size = 1 + below(random, 40);
        Rendering rendering(job, options, std::move(state));
        const int rows =
            random.next_1d() < 0.5f ? 1 << 30 : 1 + below(random, 200); // until it is interrupted
        std::atomic<int> asked = 0;
        done = rendering.take(wanted, {}, [&] { return ++asked > rows; });
        state = std::move(rendering).finish();
        if (random.next_1d() < 0.2f) state = through_a_file(std::move(state), directory);
    }
    return state;
}

// Adds them up in a random tree.
RenderState merge(std::vector<RenderState> parts, TestRandom& random)
{
    while (parts.size() > 1) {
        const auto into = static_cast<std::size_t>(below(random, static_cast<int>(parts.size())));
        auto from = static_cast<std::size_t>(below(random, static_cast<int>(parts.size()) - 1));
        if (from >= into) ++from;
        parts[into] += parts[from];
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(from));
    }
    return std::move(parts.front());
}

void check_law(int cases)
{
    const char* const given = std::getenv("PLUMB_TEST_SEED");
    const std::uint64_t seed = given ? std::strtoull(given, nullptr, 10) : std::random_device()();
    INFO("PLUMB_TEST_SEED=" << seed);
    TestRandom random(seed);
    const TempDirectory directory;
    // Whole images and parts by integrators of their own, each of which learns where caustics and windows are.
    std::vector<LoadedScene> loaded, of_parts;
    for (const std::string& scene : scenes) {
        loaded.push_back(test::load_text(scene));
        of_parts.push_back(test::load_text(scene));
    }
    const auto learnt = [&](std::size_t i) {
        const RenderJob& job = loaded[i].job;
        return train(*job.integrator, *job.scene, *job.camera, 3).value();
    };
    CHECK(learnt(0).cells > 0);
    CHECK(learnt(4).windows > 0);
    for (int i = 0; i < cases; ++i) {
        INFO("case " << i);
        const auto chosen = static_cast<std::size_t>(below(random, std::size(scenes)));
        const RenderJob& job = loaded[chosen].job;
        RenderOptions options;
        options.seed = random.next_bits();
        options.samples_per_pixel = static_cast<std::uint64_t>(1 + below(random, 20));
        if (random.next_1d() < 0.5f) {
            const int x = below(random, width);
            const int y = below(random, height);
            options.crop = PixelRect{x, y, 1 + below(random, width - x), 1 + below(random, height - y)};
        }
        if (!job.sampler->depends_on_total() && random.next_1d() < 0.3f) {
            options.adaptive = random.between(0.09, 0.35);
            options.samples_per_pixel = static_cast<std::uint64_t>(1 + below(random, 80));
        }
        const RenderState expected = render(job, options);

        // Of an adaptive rendering each part by samples would take the pilots, and their rays, again.
        const PartBy by = options.adaptive || random.next_1d() < 0.5f ? PartBy::tiles : PartBy::samples;
        const auto count = static_cast<std::uint64_t>(1 + below(random, 6));
        std::vector<RenderState> parts;
        for (std::uint64_t part = 0; part < count; ++part)
            parts.push_back(
                take(of_parts[chosen].job, options,
                     part_of(render_window(job, options), options.samples_per_pixel, by, part, count), random,
                     directory));
        REQUIRE(same_bits(merge(std::move(parts), random), expected));
    }
}

} // namespace

TEST_CASE("images depend on the samples taken and on nothing else", "[regression][determinism][law]")
{
    check_law(25);
}

TEST_CASE("images depend on the samples taken and on nothing else: at length",
          "[regression][determinism][law][slow]")
{
    check_law(1000);
}
