// SPDX-License-Identifier: MIT

// Layers of parts of the light: what integrators note, where it counts, and that it adds up.

#include "plumb/base/error.h"
#include "plumb/render/light_split.h"
#include "render/share_rounding.h"
#include "support/catch.h"
#include "support/integrators.h"
#include "support/random.h"
#include "support/scene_text.h"

#include <algorithm>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

using Names = std::vector<std::string>;

std::vector<LightSplit> splits(const Names& texts)
{
    return light_splits_from_text(texts);
}

// A mirror, a pane of glass and a diffuse wall, two lamps, a point light and two skies.
LittleScene many_lights()
{
    LittleScene scene;
    scene.rectangle({0.f, -1.f, 3.f}, 6.f, 6.f, {0.f, 1.f, 0.f}, diffuse(Color(0.8f, 0.5f, 0.2f)))
        .rectangle({0.f, 0.f, 6.f}, 4.f, 4.f, {0.f, 0.f, -1.f}, mirror())
        .sphere({-0.7f, 0.f, 3.f}, 0.5f, glass())
        .sphere({0.8f, -0.5f, 3.f}, 0.4f, diffuse(0.6f))
        .sphere({0.f, 2.f, 3.f}, 0.7f, diffuse(0.5f), Color(3.f, 2.f, 1.f))
        .rectangle({-2.f, 0.f, 3.f}, 1.f, 1.f, {1.f, 0.f, 0.f}, diffuse(0.3f), Color(1.f, 2.f, 4.f))
        .point_light({1.f, 1.f, 1.f}, Color(2.f))
        .environment(Color(0.3f, 0.2f, 0.1f))
        .environment(Color(0.1f, 0.2f, 0.3f));
    return scene;
}

// Exactly what a film adds up: in units of 2^-64, of a pixel's red, green and blue, and of each layer's.
__extension__ typedef __int128 Sum;
Sum sum_at(const std::uint32_t* words)
{
    __extension__ typedef unsigned __int128 Unsigned;
    Unsigned sum = 0;
    for (int i = 0; i < 4; ++i) sum |= Unsigned{words[i]} << (32 * i);
    return static_cast<Sum>(sum);
}
struct PixelSums {
    std::vector<Sum> beauty = std::vector<Sum>(3);
    std::vector<std::vector<Sum>> layers; // of each: red, green, blue
};
PixelSums sums_of(const Film& film, Vec2i pixel)
{
    PixelSums sums;
    const Film::Words words = film.words(pixel);
    for (std::size_t c = 0; c < 3; ++c) sums.beauty[c] = sum_at(&words[4 * c]);
    std::vector<std::uint32_t> layers(film.layer_word_names().size());
    film.layer_words(pixel, layers);
    for (std::size_t i = 0; i < film.layers().size(); ++i) {
        sums.layers.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) sums.layers.back().push_back(sum_at(&layers[12 * i + 4 * c]));
    }
    return sums;
}

template <class Action>
void for_each_pixel(const Film& film, const Action& action)
{
    for (int y = 0; y < film.window().height; ++y)
        for (int x = 0; x < film.window().width; ++x) action(Vec2i(x, y));
}

constexpr const char* room = R"(
  <sampler type='independent'/>
  <camera type='perspective'><integer name='width' value='12'/><integer name='height' value='10'/>
    <transform name='toWorld'><lookat origin='0,0,-0.9' target='0,0,1' up='0,1,0'/></transform></camera>
  <shape type='rectangle'><vector name='normal' value='0,1,0'/><point name='center' value='0,-0.5,0'/>
    <float name='width' value='9'/><float name='height' value='9'/>
    <bsdf type='diffuse'><color name='albedo' value='0.7,0.6,0.5'/></bsdf></shape>
  <shape type='sphere'><point name='center' value='0.5,0,1'/><float name='radius' value='0.4'/>
    <bsdf type='diffuse'><color name='albedo' value='0.5,0.8,0.9'/></bsdf></shape>
  <shape type='sphere'><point name='center' value='-0.5,0,1'/><float name='radius' value='0.4'/>
    <bsdf type='dielectric'/></shape>
  <shape type='sphere'><point name='center' value='0,3,0'/><float name='radius' value='2'/>
    <emitter type='area'><color name='radiance' value='1,1,1'/></emitter></shape>
  <shape type='sphere'><point name='center' value='1,0.5,1'/><float name='radius' value='0.1'/>
    <emitter type='area'><color name='radiance' value='9,5,1'/></emitter></shape>
)";

LoadedScene room_with(const std::string& integrator)
{
    return load_text("<scene dialect='plumb'>" + integrator + room + "</scene>");
}

// Without what looks for lamps alone, of which a part is seen after more bounces.
std::string integrator(const std::string& type, const std::string& more = {})
{
    const bool looks = type == "path_mis";
    return fmt::format("<integrator type='{}'>{}{}</integrator>", type,
                       looks ? "<integer name='outlineRays' value='0'/>" : "", more);
}

Film render_split(const LoadedScene& scene, const Names& texts, std::uint64_t samples = 32)
{
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.splits = splits(texts);
    return std::move(render(scene.job, options).film);
}

} // namespace

TEST_CASE("splits are words with a number", "[unit][split]")
{
    CHECK(to_texts(splits({"depth", "light:3", "technique"})) == Names{"depth", "light:3", "technique"});
    CHECK(to_texts(splits({"depth:8"})) == Names{"depth"});
    const auto complaint = [](const Names& texts) {
        try {
            splits(texts);
            return std::string("none");
        } catch (const Error& error) {
            return std::string(error.what());
        }
    };
    CHECK(complaint({"lights"}) == "unknown split 'lights'; known are depth, technique and light");
    CHECK(complaint({"depth:0"}) == "the number of layers must be from 1 to 63, not '0'");
    CHECK(complaint({"light:"}) == "the number of layers must be from 1 to 63, not ''");
    CHECK(complaint({"technique:2"}) == "'technique' takes no number, but is 'technique:2'");
    CHECK(complaint({"depth", "depth:2"}) == "'depth' is there twice");
}

TEST_CASE("an integrator notes every contribution, up to what it returns", "[unit][split]")
{
    const Scene scene = many_lights().build();
    std::vector<NamedParams> all = path_tracers(-1);
    for (const NamedParams& direct : direct_light_integrators()) all.push_back(direct);
    all.push_back({"whitted", integrator_params("whitted")});
    for (const NamedParams& named : all) {
        CAPTURE(named.name);
        std::unique_ptr<Integrator> integrator;
        try {
            integrator = make_integrator(named.params, scene);
        } catch (const Error&) {
            continue; // an environment has no area
        }
        REQUIRE(integrator->notes_light());
        LightNotes notes;
        Tracer tracer(scene, {.light = &notes});
        Tracer silent(scene);
        const auto sampler = independent_sampler();
        const ChooseRay choose = rays_around({0.f, 0.f, -1.f}, {0.f, 0.f, 3.f}, 1.5f);
        int lit = 0;
        for (std::uint64_t i = 0; i < 2000; ++i) {
            notes.clear();
            sampler->start(3, {0, 0}, i);
            const Color found = integrator->radiance(tracer, *sampler, choose(*sampler));
            sampler->start(3, {0, 0}, i);
            REQUIRE(found == integrator->radiance(silent, *sampler, choose(*sampler)));
            Color before(0.f);
            for (const LightNote& note : notes.all()) {
                REQUIRE(min_component(note.sum - before) >= 0.f);
                REQUIRE((note.emitter == environment_index || note.emitter < scene.emitters().size()));
                before = note.sum;
            }
            REQUIRE(before == found);
            lit += found.is_black() ? 0 : 1;
        }
        CHECK(lit > 200);
    }
}

TEST_CASE("shares add up to beauty, as exact sums and as floats", "[unit][split]")
{
    for (const char* filter : {"box", "gaussian"}) {
        LoadedScene scene =
            load_text(fmt::format("<scene dialect='plumb'><integrator type='path_mis'/>{}</scene>",
                                  std::string(room).insert(std::string(room).find("</camera>"),
                                                           fmt::format("<rfilter type='{}'/>", filter))));
        const Film film = render_split(scene, {"depth:3", "technique", "light:1"});
        const ChannelSet& layers = film.layers();
        REQUIRE(layer_names(layers) ==
                "by_depth.0, by_depth.1, by_depth.2, by_depth.more, by_technique.view, "
                "by_technique.emitter_sampling, by_technique.direction_sampling, "
                "by_light.1, by_light.more");
        const Image image = film.develop();
        for_each_pixel(film, [&](Vec2i pixel) {
            const PixelSums sums = sums_of(film, pixel);
            const float* values = image.pixel(pixel.x, pixel.y);
            for (const auto& [first, last] : {std::pair(0, 4), std::pair(4, 7), std::pair(7, 9)}) {
                for (int c = 0; c < 3; ++c) {
                    Sum sum = 0;
                    double value = 0.0;
                    for (int layer = first; layer < last; ++layer) {
                        sum += sums.layers[std::size_t(layer)][std::size_t(c)];
                        value += static_cast<double>(values[3 + 3 * layer + c]);
                    }
                    REQUIRE((sum == sums.beauty[std::size_t(c)]));
                    REQUIRE(static_cast<float>(value) == values[c]);
                }
            }
        });
    }
}

TEST_CASE("the shares of the first depths are the image of that depth, bit for bit", "[unit][split]")
{
    for (const std::string type : {"path", "path_nee", "path_mis"}) {
        const Film film = render_split(room_with(integrator(type)), {"depth:4"});
        for (int depth = 0; depth < 4; ++depth) {
            CAPTURE(type, depth);
            const Film shallow = render_split(
                room_with(integrator(type, fmt::format("<integer name='maxDepth' value='{}'/>", depth))), {});
            for_each_pixel(film, [&](Vec2i pixel) {
                const PixelSums sums = sums_of(film, pixel);
                for (std::size_t c = 0; c < 3; ++c) {
                    Sum sum = 0;
                    for (int d = 0; d <= depth; ++d) sum += sums.layers[std::size_t(d)][c];
                    REQUIRE((sum == sums_of(shallow, pixel).beauty[c]));
                }
            });
        }
    }
}

TEST_CASE("techniques find what they can", "[unit][split]")
{
    enum { view, emitter_sampling, direction_sampling };
    const auto means = [](const std::string& type) {
        // Without roulette, whose numbers depend on what was drawn for emitters.
        const Film film = render_split(
            room_with(
                integrator(type, "<integer name='rrDepth' value='4'/><integer name='maxDepth' value='4'/>")),
            {"technique"}, 64);
        std::vector<double> found(3);
        for_each_pixel(film, [&](Vec2i pixel) {
            const PixelSums sums = sums_of(film, pixel);
            for (std::size_t i = 0; i < 3; ++i) found[i] += static_cast<double>(sums.layers[i][1]) * 0x1p-64;
        });
        return found;
    };
    const std::vector<double> path = means("path"), nee = means("path_nee"), mis = means("path_mis");
    CHECK(path[emitter_sampling] == 0.0);
    CHECK(path[direction_sampling] > 0.0);
    CHECK(nee[emitter_sampling] > 0.0);
    // Caustics of the glass ball alone.
    CHECK(nee[direction_sampling] < 0.2 * nee[emitter_sampling]);
    CHECK(nee[direction_sampling] > 0.0);
    CHECK(mis[emitter_sampling] > 0.0);
    CHECK(mis[emitter_sampling] < nee[emitter_sampling]);
    CHECK(mis[direction_sampling] > nee[direction_sampling]);
    // The camera and the glass sample the same.
    CHECK(path[view] == nee[view]);
    CHECK(path[view] == mis[view]);
}

TEST_CASE("the most powerful lights have layers of their own, infinite ones one together", "[unit][split]")
{
    const Scene scene = many_lights().build();
    CHECK(layer_names(layers_of(splits({"light"}), scene)) ==
          "by_light.1, by_light.2, by_light.3, by_light.4, by_light.more");
    const Names table = light_table(splits({"light:1"}), scene);
    REQUIRE(table.size() == 1);
    CHECK(table[0] == "4 light 2 and light 3"); // the skies
    CHECK(light_table(splits({"depth"}), scene).empty());

    const LoadedScene loaded = room_with("<integrator type='path_mis'/>");
    CHECK(light_table(splits({"light"}), *loaded.job.scene) ==
          Names{"1 shape 'sphere' (scene.xml:12)", "2 shape 'sphere' (scene.xml:14)"});
}

TEST_CASE("the share of a light is the image with this light alone", "[unit][split]")
{
    // Every light is sampled, one after the other: the first has the same random numbers with and without the second.
    const auto make = [](bool both) {
        std::string text = room;
        const std::string second = "<shape type='sphere'><point name='center' value='1,0.5,1'/>";
        if (!both) text.erase(text.find(second));
        return load_text("<scene dialect='plumb'><integrator type='direct_whitted'/>" + text + "</scene>");
    };
    const Film film = render_split(make(true), {"light"});
    const Film alone = render_split(make(false), {});
    // As floats: the second light is added to the first before the film rounds the sum. Where the second lamp is in the way,
    // the images differ.
    int same = 0, all = 0;
    for_each_pixel(film, [&](Vec2i pixel) {
        const double share = static_cast<double>(sums_of(film, pixel).layers[0][0]);
        const double image = static_cast<double>(sums_of(alone, pixel).beauty[0]);
        same += std::abs(share - image) <= 1e-6 * image ? 1 : 0;
        ++all;
    });
    CHECK(same > all / 2);
}

TEST_CASE("shares of any sizes round to floats that add up", "[unit][split]")
{
    TestRandom random(11);
    ChannelSet layers;
    for (int i = 0; i < 7; ++i)
        layers.push_back({fmt::format("by_depth.{}", i), {"R", "G", "B"}, LayerKind::share});
    const std::vector<ShareFamily> families = share_families(layers);
    REQUIRE(families.size() == 1);
    for (int round = 0; round < 200000; ++round) {
        const double range = random.between(0.0, 30.0);
        std::vector<float> floats(21);
        float beauty[3] = {};
        double exact[3] = {};
        for (std::size_t i = 0; i < 21; ++i) {
            double value = std::exp2(-random.next_double() * range) * random.next_double();
            if (random.next_double() < 0.2) value = 0.0;
            floats[i] = static_cast<float>(value);
            exact[i % 3] += value;
        }
        for (int c = 0; c < 3; ++c) beauty[c] = static_cast<float>(exact[c]);
        const std::vector<float> nearest = floats;
        make_shares_add_up(families[0], floats.data(), beauty);
        for (std::size_t c = 0; c < 3; ++c) {
            double up = 0.0, down = 0.0;
            for (std::size_t i = 0; i < 7; ++i) {
                up += static_cast<double>(floats[3 * i + c]);
                down += static_cast<double>(floats[3 * (6 - i) + c]);
                REQUIRE(std::abs(floats[3 * i + c] - nearest[3 * i + c]) <=
                        4e-7f * (1.f + std::abs(nearest[3 * i + c])));
                if (nearest[3 * i + c] == 0.f) REQUIRE(floats[3 * i + c] == 0.f);
            }
            REQUIRE(static_cast<float>(up) == beauty[c]);
            REQUIRE(static_cast<float>(down) == beauty[c]);
        }
    }
}

TEST_CASE("shares that cancel add up as far as their last bits allow", "[unit][split]")
{
    const ChannelSet layers = {{"by_light.1", {"R", "G", "B"}, LayerKind::share},
                               {"by_light.more", {"R", "G", "B"}, LayerKind::share}};
    std::vector<float> floats = {0.3f, -0.3f, 1e-8f, -0.29999f, 0.3f, 0.f};
    const float beauty[3] = {1e-5f, 0.f, 1e-8f};
    make_shares_add_up(share_families(layers).front(), floats.data(), beauty);
    CHECK(std::abs(floats[0] + floats[3] - beauty[0]) <= 3e-8f);
    CHECK(floats[1] + floats[4] == 0.f);
    CHECK(floats[2] == 1e-8f);
    CHECK(floats[5] == 0.f);
}

TEST_CASE("integrators that show no light cannot be split", "[unit][split]")
{
    const LoadedScene scene = room_with("<integrator type='normals'/>");
    CHECK_THROWS_WITH(
        render_split(scene, {"depth"}),
        "--split needs an integrator that follows light from emitters, such as path_mis or whitted; choose "
        "one with --integrator");
}
