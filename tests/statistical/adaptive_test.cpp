// SPDX-License-Identifier: MIT

// Adaptive renderings are unbiased, and so are their error bars.

#include "plumb/render/adaptive.h"
#include "plumb/render/evidence.h"
#include "support/catch.h"
#include "support/random.h"
#include "support/scene_text.h"
#include "support/statistics.h"

using namespace plumb;
using namespace plumb::test;

namespace {

constexpr std::uint64_t maximum = 512;
constexpr double target = 0.125; // usually 64 samples

// Of mean 1, and so skewed that a mean which decided itself when it is good enough would be too dark.
double skewed(TestRandom& random)
{
    return random.next_double() < 0.02 ? 50.0 : 0.0;
}

// One pixel: the mean of the samples that its pilot asks for, and its estimated variance.
struct Pixel {
    std::uint64_t samples = 0;
    double mean = 0.0;
    double variance_of_mean = 0.0;
};

Pixel adaptive_pixel(TestRandom& random)
{
    const AdaptiveRule rule(target);
    std::vector<double> pilot(rule.pilot_size());
    for (double& value : pilot) value = skewed(random);
    const std::uint64_t count = rule.samples(pilot);
    MeanAndVariance samples;
    for (std::uint64_t i = 0; i < count; ++i) samples.add(skewed(random));
    return {count, samples.mean(), samples.variance() / static_cast<double>(count)};
}

// A glass ball and a small bright lamp, noise of all sizes: smooth floor, edges, a caustic.
const LoadedScene& uneven_scene()
{
    static const LoadedScene scene = load_text(R"(<scene dialect="plumb">
  <integrator type="path_mis"><boolean name="guide" value="false"/></integrator><sampler type="independent"/>
  <camera type="perspective"><integer name="width" value="20"/><integer name="height" value="15"/>
    <float name="fov" value="40"/>
    <transform name="toWorld"><lookat origin="0,1.5,5" target="0,0.9,0" up="0,1,0"/></transform></camera>
  <shape type="rectangle"><vector name="normal" value="0,1,0"/><float name="width" value="8"/>
    <float name="height" value="8"/><bsdf type="diffuse"/></shape>
  <shape type="sphere"><point name="center" value="-0.8,0.6,0"/><float name="radius" value="0.6"/>
    <bsdf type="roughdielectric"><float name="alpha" value="0.2"/></bsdf></shape>
  <shape type="sphere"><point name="center" value="0.6,1.6,0"/><float name="radius" value="0.3"/>
    <emitter type="area"><color name="radiance" value="9,8,7"/></emitter></shape></scene>)");
    return scene;
}

RenderState rendered(std::uint64_t seed, std::optional<double> adaptive, std::uint64_t samples)
{
    RenderOptions options;
    options.seed = seed;
    options.adaptive = adaptive;
    options.samples_per_pixel = samples;
    return render(uneven_scene().job, options);
}

// The mean of the image's pixels, each divided by what a long rendering has there: no pixel counts more than others.
double evenly_weighted(const Film& film)
{
    static const Image weights = rendered(99, {}, 1024).film.develop();
    const Image image = film.develop();
    double sum = 0.0;
    for (int y = 0; y < 15; ++y)
        for (int x = 0; x < 20; ++x)
            sum += static_cast<double>(image.color(x, y).g) /
                   std::max(static_cast<double>(weights.color(x, y).g), 0.01);
    return sum / 300.0;
}

} // namespace

TEST_CASE("a pilot that decides biases neither the mean nor its error bars", "[statistical][adaptive]")
{
    const double level = sidak_level(significance, 2);
    std::uint64_t least = maximum;
    std::uint64_t most = 0;
    const auto estimates = [&](std::uint64_t pixels, std::uint64_t seed, auto&& value) {
        TestRandom random(seed);
        MeanAndVariance result;
        for (std::uint64_t i = 0; i < pixels; ++i) {
            const Pixel pixel = adaptive_pixel(random);
            least = std::min(least, pixel.samples);
            most = std::max(most, pixel.samples);
            result.add(value(pixel));
        }
        return result;
    };
    check_mean(
        "mean", 1.0,
        [&](std::uint64_t n, std::uint64_t seed) {
            return estimates(n, seed, [](const Pixel& pixel) { return pixel.mean; });
        },
        20000, level);
    check_mean(
        "error bars", 0.0,
        [&](std::uint64_t n, std::uint64_t seed) {
            return estimates(n, seed, [](const Pixel& pixel) {
                return (pixel.mean - 1.0) * (pixel.mean - 1.0) - pixel.variance_of_mean;
            });
        },
        20000, level, 2);
    CHECK(least == AdaptiveRule(target).least());
    CHECK(most >= 2 * least);
}

TEST_CASE("adaptive renderings have the mean of plain ones", "[statistical][adaptive]")
{
    const auto of_images = [](std::uint64_t images, std::uint64_t seed, std::optional<double> adaptive,
                              std::uint64_t samples) {
        MeanAndVariance result;
        for (std::uint64_t i = 0; i < images; ++i)
            result.add(evenly_weighted(rendered(seed * 1000000 + i, adaptive, samples).film));
        return result;
    };
    check_statistic(
        "adaptive and plain",
        [&](std::uint64_t images, std::uint64_t seed) {
            return same_mean_outcome(of_images(images, seed, target, maximum),
                                     of_images(images, seed + 1, {}, 64));
        },
        40, significance);
}

TEST_CASE("the error bars of adaptive renderings are true", "[statistical][adaptive]")
{
    // Two images of other seeds: the expectation of (a - b)^2 is var a + var b, in each pixel.
    const auto excess = [](const Film& a, const Film& b) {
        const Image image_a = a.develop();
        const Image image_b = b.develop();
        double sum = 0.0;
        for (int y = 0; y < 15; ++y) {
            for (int x = 0; x < 20; ++x) {
                const double difference =
                    static_cast<double>(image_a.color(x, y).g) - static_cast<double>(image_b.color(x, y).g);
                sum += difference * difference - static_cast<double>(a.variance_of_mean({x, y}).g) -
                       static_cast<double>(b.variance_of_mean({x, y}).g);
            }
        }
        return sum / 300.0;
    };
    const auto counts = make_evidence({}, rendered(1, target, maximum));
    CHECK(counts.samples_per_pixel == AdaptiveRule(target).least());
    CHECK(counts.most_samples_per_pixel >= 4 * counts.samples_per_pixel);
    check_mean(
        "error bars", 0.0,
        [&](std::uint64_t pairs, std::uint64_t seed) {
            MeanAndVariance result;
            for (std::uint64_t i = 0; i < pairs; ++i)
                result.add(excess(rendered(seed * 1000000 + 2 * i, target, maximum).film,
                                  rendered(seed * 1000000 + 2 * i + 1, target, maximum).film));
            return result;
        },
        40, significance);
}
