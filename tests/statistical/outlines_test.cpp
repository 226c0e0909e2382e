// SPDX-License-Identifier: MIT

// Rays that look for lamps where their outlines are seen: the image keeps its mean, has less noise, and obeys the law.

#include "plumb/render/render.h"
#include "plumb/scene/tracer.h"
#include "plumb/statistics/mean_and_variance.h"
#include "support/catch.h"
#include "support/integrators.h"
#include "support/scene_text.h"
#include "support/statistics.h"

#include <fmt/format.h>

namespace plumb {
class RoughConductor;
}

using namespace plumb;
using namespace plumb::test;

namespace {

std::unique_ptr<Bsdf> rough_metal()
{
    return ParamsBuilder("bsdf", "roughconductor").number("alpha", 0.2).build<RoughConductor, Bsdf>();
}

constexpr int width = 14;
constexpr int height = 10;

struct View {
    std::string camera = "perspective";
    std::string more; // children of the camera
    std::string filter = "box";
    std::string sampler = "independent";
};

// A lamp that reflects, partly hidden; a second one before it, behind a pane that is half there; a small one far away; a wall
// that they light, a mirror, a plate nearly as smooth, a ball of glass, and a sky.
LoadedScene scene(const View& view, int rays, const std::string& more = {})
{
    return load_text(fmt::format(
        R"(<scene dialect="plumb">
  <integrator type="path_mis"><integer name="outlineRays" value="{}"/><integer name="maxDepth" value="3"/></integrator>
  <sampler type="{}"/>
  <camera type="{}"><integer name="width" value="{}"/><integer name="height" value="{}"/>{}<rfilter type="{}"/>
    <transform name="toWorld"><lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform></camera>
  <shape type="rectangle"><point name="center" value="0,0,-2"/><vector name="normal" value="0,0,1"/>
    <float name="width" value="9"/><float name="height" value="9"/><bsdf type="diffuse"/></shape>
  <shape type="sphere"><point name="center" value="-0.6,0.2,0"/><float name="radius" value="0.5"/>
    <bsdf type="diffuse"><color name="reflectance" value="0.6,0.6,0.6"/></bsdf>
    <emitter type="area"><color name="radiance" value="9,7,5"/></emitter></shape>
  <shape type="cube"><point name="center" value="-0.9,0.5,0.7"/><float name="width" value="0.5"/><bsdf type="diffuse"/></shape>
  <shape type="rectangle"><point name="center" value="0.5,-0.2,0.5"/><vector name="normal" value="0.3,0.2,1"/>
    <bsdf type="diffuse"/><emitter type="area"><color name="radiance" value="1,3,2"/></emitter></shape>
  <shape type="rectangle"><point name="center" value="0.8,0,1"/><vector name="normal" value="0,0,1"/>
    <bsdf type="mask"><float name="opacity" value="0.5"/><bsdf type="diffuse"/></bsdf></shape>
  <shape type="sphere"><point name="center" value="1.3,1.1,-0.5"/><float name="radius" value="0.07"/>
    <emitter type="area"><color name="radiance" value="200,200,200"/></emitter></shape>
  <shape type="rectangle"><point name="center" value="0,-1.4,0"/><vector name="normal" value="0,1,0.2"/>
    <float name="width" value="4"/><float name="height" value="2"/><bsdf type="mirror"/></shape>
  <shape type="rectangle"><point name="center" value="-2,0.5,-0.5"/><vector name="normal" value="1,0,0.8"/>
    <float name="width" value="2"/><float name="height" value="2"/>
    <bsdf type="roughconductor"><float name="alpha" value="0.03"/></bsdf></shape>
  <shape type="sphere"><point name="center" value="0.3,1,0.8"/><float name="radius" value="0.4"/><bsdf type="dielectric"/></shape>
  <emitter type="environment"><color name="radiance" value="0.3,0.3,0.3"/></emitter>{}</scene>)",
        rays, view.sampler, view.camera, width, height, view.more, view.filter, more));
}

RenderState rendered(const LoadedScene& scene, std::uint64_t seed, std::uint64_t samples)
{
    RenderOptions options;
    options.seed = seed;
    options.samples_per_pixel = samples;
    return render(scene.job, options);
}

// Sums over the image, in which neighbours have other weights: with alternating signs a light that moves to the next pixel is noticed.
struct Sums {
    double all = 0.0;
    double alternating = 0.0;
};
Sums sums_of(const Film& film)
{
    const Image image = film.develop();
    Sums sums;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double value = static_cast<double>(luminance(image.color(x, y)));
            sums.all += value;
            sums.alternating += (x + y) % 2 == 0 ? value : -value;
        }
    return sums;
}

MeanAndVariance estimate(const LoadedScene& scene, double Sums::*part, std::uint64_t images,
                         std::uint64_t seed)
{
    MeanAndVariance result;
    for (std::uint64_t i = 0; i < images; ++i)
        result.add(sums_of(rendered(scene, seed * 1000003 + i, 4).film).*part);
    return result;
}

const std::string wide = "<float name='fov' value='50'/>";
const std::vector<std::pair<std::string, View>>& views()
{
    static const std::vector<std::pair<std::string, View>> all{
        {"pinhole", {"perspective", wide}},
        {"tent", {"perspective", wide, "tent"}},
        {"gaussian, sobol", {"perspective", wide, "gaussian", "sobol"}},
        {"cut filter, stratified",
         {"perspective", wide + "<boolean name='sampleBorder' value='false'/>", "gaussian", "stratified"}},
        {"negative lobes", {"perspective", wide, "mitchell"}},
        {"lens",
         {"perspective",
          wide + "<float name='lensRadius' value='0.3'/><float name='focalDistance' value='4'/>", "box",
          "sobol"}},
        {"orthographic", {"orthographic", "<float name='viewWidth' value='4'/>"}},
        {"fisheye", {"fisheye", "<float name='fov' value='60'/>", "tent"}},
    };
    return all;
}

} // namespace

TEST_CASE("rays that look for lamps change no mean", "[statistical][outlines]")
{
    for (const auto& [name, view] : views()) {
        const LoadedScene with = scene(view, 16);
        const LoadedScene without = scene(view, 0);
        for (double Sums::*const part : {&Sums::all, &Sums::alternating})
            check_same_mean(
                fmt::format("{}, {}", name, part == &Sums::all ? "sum" : "alternating sum"),
                [&](std::uint64_t n, std::uint64_t seed) { return estimate(with, part, n, seed); },
                [&](std::uint64_t n, std::uint64_t seed) { return estimate(without, part, n, seed); }, 150,
                sidak_level(significance, 2 * views().size()));
    }
}

// Several looks and emitter samples share the light in another way, so of those two techniques the sum is tested.
TEST_CASE("rays that look for lamps change the mean of no layer", "[statistical][outlines]")
{
    const View view{"perspective", wide, "tent"};
    const LoadedScene with = scene(view, 16);
    const LoadedScene without = scene(view, 0);
    const std::vector<std::string> splits{"depth:3", "technique", "light:3"};
    using Layers = std::vector<std::size_t>;
    const std::vector<Layers> tested{{0}, {1}, {2}, {3}, {4}, {5, 6}, {7}, {8}, {9}, {10}};
    const auto estimates = [&](const LoadedScene& loaded, const Layers& layers, std::uint64_t images,
                               std::uint64_t seed) {
        MeanAndVariance result;
        for (std::uint64_t i = 0; i < images; ++i) {
            RenderOptions options;
            options.seed = seed * 1000003 + i;
            options.samples_per_pixel = 4;
            options.splits = light_splits_from_text(splits);
            const Image image = render(loaded.job, options).film.develop();
            double sum = 0.0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    for (const std::size_t layer : layers)
                        sum += static_cast<double>(image.pixel(x, y)[3 + 3 * layer + 1]);
            result.add(sum);
        }
        return result;
    };
    for (const Layers& layers : tested)
        check_same_mean(
            fmt::format("layer {}", layers.front()),
            [&](std::uint64_t n, std::uint64_t seed) { return estimates(with, layers, n, seed); },
            [&](std::uint64_t n, std::uint64_t seed) { return estimates(without, layers, n, seed); }, 100,
            sidak_level(significance, tested.size()));
}

TEST_CASE("where lamps have outlines, rays that look for them take most of the noise",
          "[statistical][outlines]")
{
    const View view{"perspective", wide, "box", "sobol"};
    const auto variance = [&](int rays) {
        const LoadedScene loaded = scene(view, rays);
        std::vector<MeanAndVariance> pixels(width * height);
        for (std::uint64_t i = 0; i < 24; ++i) {
            const Image image = rendered(loaded, i, 16).film.develop();
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    pixels[static_cast<std::size_t>(y * width + x)].add(
                        static_cast<double>(image.color(x, y).g));
        }
        double sum = 0.0;
        for (const MeanAndVariance& pixel : pixels) sum += pixel.variance();
        return sum;
    };
    CHECK(variance(16) < 0.25 * variance(0));
}

TEST_CASE("what looks for lamps finds what the rest leaves out", "[statistical][outlines]")
{
    // A metal plate that is found by directions and by emitter samples alike, a mirror and a lamp to see; and a sky, for which
    // several looks for lamps do not look.
    LittleScene little;
    little.environment(Color(0.3f))
        .rectangle(Vec3f(0.f), 6.f, 6.f, Vec3f(0, 1, 0), rough_metal)
        .rectangle(Vec3f(2.f, 1.f, 0.f), 3.f, 3.f, Vec3f(-1, 0, 0), mirror())
        .rectangle(Vec3f(0.f, 1.5f, -1.5f), 1.5f, 1.f, Vec3f(0, 0, 1), diffuse(0.4f), Color(3.f));
    const Scene lit = little.build();
    const ChooseRay at_the_plate = rays_around(Vec3f(0.f, 1.f, 4.f), Vec3f(0.f, 0.f, 0.5f), 0.5f);
    const ChooseRay everywhere = rays_around(Vec3f(0.f, 1.f, 4.f), Vec3f(0.f, 0.6f, 0.f), 1.5f);
    for (const int candidates : {0, 1, 4}) {
        const ChooseRay& rays = candidates == 0 ? everywhere : at_the_plate;
        const auto integrator = make_integrator(
            integrator_params("path_mis").integer("candidates", std::max(candidates, 1)), lit);
        const auto difference = [&](std::uint64_t samples, std::uint64_t seed) {
            MeanAndVariance result;
            const auto sampler = independent_sampler();
            Tracer all(lit), rest(lit);
            rest.expect_looks(8);
            for (std::uint64_t i = 0; i < samples; ++i) {
                const auto next_ray = [&](std::uint64_t kind) {
                    sampler->start(seed, {0, 0}, 3 * i + kind);
                    return rays(*sampler);
                };
                const Ray a = next_ray(0);
                double value = luminance(integrator->radiance(all, *sampler, a));
                const Ray b = next_ray(1);
                value -= luminance(integrator->radiance(rest, *sampler, b));
                const Ray c = next_ray(2);
                value -= luminance(integrator->look(rest, *sampler, c));
                result.add(value);
            }
            return result;
        };
        check_mean(fmt::format("{} candidates", candidates), 0.0, difference, 400000,
                   sidak_level(significance, 3));
    }
}

TEST_CASE("with outlines, too, a sample is a function of seed, pixel and index", "[statistical][outlines]")
{
    for (const auto& [name, view] : views()) {
        INFO(name);
        const LoadedScene loaded = scene(view, 16);
        RenderOptions options;
        options.samples_per_pixel = 8;
        options.splits = light_splits_from_text(std::vector<std::string>{"depth", "technique", "light"});
        const RenderState whole = render(loaded.job, options);

        RenderOptions other = options;
        other.crop = PixelRect{4, 3, 5, 4};
        other.tile_size = 3;
        other.threads = 3;
        const RenderState crop = render(loaded.job, other);
        for (int y = 3; y < 7; ++y)
            for (int x = 4; x < 9; ++x) CHECK(crop.film.words({x, y}) == whole.film.words({x, y}));

        // Samples in another order, in two calls.
        Rendering parts(loaded.job, options);
        parts.take(SampleSet(SampleBlock{{0, 0, width, height}, 5, 8}));
        parts.take(SampleSet(SampleBlock{{0, 0, width, height}, 0, 5}));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                CHECK(parts.state().film.words({x, y}) == whole.film.words({x, y}));
        CHECK(parts.state().rays.total() == whole.rays.total());

        // What is replayed of a pixel is what the image has there.
        RenderOptions one = options;
        one.crop = PixelRect{5, 4, 1, 1};
        const Color pixel = render(loaded.job, one).film.develop().color(5, 4);
        Color sum(0.f);
        for (std::uint64_t i = 0; i < 8; ++i) {
            const ReplayedSample sample = replay(loaded.job, options, {5, 4}, i);
            sum += sample.value * (sample.weight / 8.f);
        }
        CHECK(std::abs(luminance(sum - pixel)) <= 1e-5f * luminance(pixel));
    }
}

TEST_CASE("outlines change nothing where they cannot be", "[statistical][outlines]")
{
    const auto image = [](int rays, const std::string& integrator_more) {
        const LoadedScene loaded = load_text(fmt::format(
            R"(<scene dialect="plumb"><integrator type="path_mis"><integer name="outlineRays" value="{}"/>{}</integrator>{}
  <shape type="sphere"><point name="center" value="0,0,4"/><bsdf type="diffuse"/></shape>
  <shape type="sphere"><point name="center" value="0,0,{}"/><emitter type="area"/></shape></scene>)",
            rays, integrator_more, test::camera, integrator_more.empty() ? -4 : 9));
        return rendered(loaded, 1, 16);
    };
    const std::string hidden = "<boolean name='hideEmitters' value='true'/>";
    for (const std::string& more : {std::string(), hidden}) {
        const RenderState with = image(8, more);
        const RenderState without = image(0, more);
        CHECK(with.rays.total() == without.rays.total());
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 8; ++x) CHECK(with.film.words({x, y}) == without.film.words({x, y}));
    }
}

TEST_CASE("filters with negative lobes have no looks for lamps", "[statistical][outlines]")
{
    for (const char* filter : {"mitchell", "catmullrom", "lanczos"}) {
        const View view{"perspective", wide, filter};
        const RenderState with = rendered(scene(view, 8), 1, 4);
        const RenderState without = rendered(scene(view, 0), 1, 4);
        CHECK(with.rays.total() == without.rays.total());
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) CHECK(with.film.words({x, y}) == without.film.words({x, y}));
    }
}
