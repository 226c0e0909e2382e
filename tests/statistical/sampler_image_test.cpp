// SPDX-License-Identifier: MIT

// Images by samplers whose samples depend on each other: their expectation is that of independent samples, and their
// error bars are upper bounds.

#include "plumb/statistics/mean_and_variance.h"
#include "support/catch.h"
#include "support/scene_text.h"
#include "support/statistics.h"

#include <array>

using namespace plumb;

namespace {

std::string scene_with(const std::string& integrator, const std::string& filter, const std::string& things)
{
    return "<scene dialect='plumb'>" + integrator +
           "<camera type='perspective'><integer name='width' value='8'/><integer name='height' value='6'/>"
           "<float name='fov' value='45'/><float name='lensRadius' value='0.1'/>"
           "<float name='focalDistance' value='5'/><transform name='toWorld'>"
           "<lookat origin='0,1.5,5' target='0,0.6,0' up='0,1,0'/></transform><rfilter type='" +
           filter +
           "'/></camera><mesh type='rectangle'><vector name='normal' value='0,1,0'/><float name='width' "
           "value='9'/><float name='height' value='9'/><bsdf type='diffuse'/></mesh>" +
           things + "</scene>";
}

const std::string lamp = "<mesh type='rectangle'><point name='center' value='0,3,0'/><vector name='normal' "
                         "value='0,-1,0'/><emitter type='area'><color name='radiance' value='9,8,7'/>"
                         "</emitter></mesh>";
const std::string small_lamp =
    "<mesh type='sphere'><point name='center' value='1,0.7,1'/><float name='radius' "
    "value='0.2'/><emitter type='area'><color name='radiance' value='3,9,9'/>"
    "</emitter></mesh>";
const std::string ball = "<mesh type='sphere'><point name='center' value='-0.5,0.7,0'/><float name='radius' "
                         "value='0.7'/>";

struct Case {
    const char* name;
    std::string scene;
};
const std::array cases = {
    Case{"one lamp, direct light",
         scene_with("<integrator type='direct_mis'/>", "box", lamp + ball + "<bsdf type='diffuse'/></mesh>")},
    Case{"two lamps, gloss, paths",
         scene_with("<integrator type='path_mis'/>", "gaussian",
                    lamp + small_lamp + ball + "<bsdf type='roughconductor'/></mesh>")},
    Case{"glass, paths with naive roulette", scene_with("<integrator type='whitted'/>", "mitchell",
                                                        lamp + ball + "<bsdf type='dielectric'/></mesh>")},
    Case{"several samples at each point",
         scene_with("<integrator type='ao'><integer name='nSamples' value='3'/></integrator>", "tent",
                    ball + "<bsdf type='diffuse'/></mesh>")},
};

LoadedScene load_with(const Case& one, const std::string& sampler)
{
    RenderSettings options;
    options.method.sampler = sampler;
    return test::load_text(one.scene, options);
}

RenderState render_with(const RenderJob& job, std::uint64_t samples, std::uint64_t seed)
{
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.seed = seed;
    options.threads = 1;
    return render(job, options);
}

double brightness(const Image& image)
{
    double sum = 0.0;
    for (int y = 0; y < image.data_window().height; ++y)
        for (int x = 0; x < image.data_window().width; ++x)
            sum += static_cast<double>(luminance(image.color(x, y)));
    return sum;
}

MeanAndVariance brightness_of_images(const RenderJob& job, std::uint64_t samples, std::uint64_t images,
                                     std::uint64_t seed)
{
    MeanAndVariance result;
    for (std::uint64_t i = 0; i < images; ++i)
        result.add(brightness(render_with(job, samples, seed * 1'000'000 + i).film.develop()));
    return result;
}

} // namespace

TEST_CASE("images of all samplers have one expectation", "[statistical][sampler]")
{
    const std::string sampler = GENERATE(as<std::string>{}, "sobol", "stratified");
    for (const Case& one : cases) {
        const LoadedScene independent = load_with(one, "independent");
        const LoadedScene other = load_with(one, sampler);
        const bool passed = test::check_statistic(
            sampler + ", " + one.name,
            [&](std::uint64_t images, std::uint64_t seed) {
                return test::same_mean_outcome(brightness_of_images(independent.job, 7, images, 2 * seed),
                                               brightness_of_images(other.job, 7, images, 2 * seed + 1));
            },
            100, test::sidak_level(test::significance, 2 * cases.size()), 1);
        CHECK(passed);
    }
}

TEST_CASE("error bars of dependent samples are upper bounds", "[statistical][sampler][evidence]")
{
    // Half the squared difference of two images is their squared error in the mean; what their error bars say must not be
    // less. Whatever the number of samples, a power of two or not.
    const std::string sampler = GENERATE(as<std::string>{}, "sobol", "stratified");
    const std::uint64_t samples = GENERATE(2, 7, 16);
    for (const Case& one : cases) {
        const LoadedScene loaded = load_with(one, sampler);
        const bool passed = test::check_statistic(
            sampler + ", " + one.name + ", samples " + std::to_string(samples),
            [&](std::uint64_t pairs, std::uint64_t seed) {
                MeanAndVariance excess; // of the squared error over the error bars
                MeanAndVariance bound;
                for (std::uint64_t i = 0; i < pairs; ++i) {
                    const Film a = render_with(loaded.job, samples, seed * 1'000'000 + 2 * i).film;
                    const Film b = render_with(loaded.job, samples, seed * 1'000'000 + 2 * i + 1).film;
                    const Image image_a = a.develop();
                    const Image image_b = b.develop();
                    double error = 0.0;
                    double bars = 0.0;
                    for (int y = 0; y < a.window().height; ++y) {
                        for (int x = 0; x < a.window().width; ++x) {
                            const Color difference = image_a.color(x, y) - image_b.color(x, y);
                            error += sqr(static_cast<double>(difference.g)) / 2.0;
                            bars += static_cast<double>(a.variance_of_mean({x, y}).g +
                                                        b.variance_of_mean({x, y}).g) /
                                    2.0;
                        }
                    }
                    excess.add(error - bars);
                    bound.add(bars);
                }
                const double share = 1.0 + excess.mean() / bound.mean();
                return test::Outcome{test::normal_survival(excess.mean() / excess.standard_error()),
                                     "squared error / error bars: " + std::to_string(share)};
            },
            50, test::sidak_level(test::significance, 6 * cases.size()), 1);
        CHECK(passed);
    }
}

TEST_CASE("sobol and stratified have less noise than independent samples", "[statistical][sampler]")
{
    const Case lit_floor{"floor", scene_with("<integrator type='direct_mis'/>", "box", lamp)};
    const auto noise = [&](const std::string& sampler) {
        const LoadedScene loaded = load_with(lit_floor, sampler);
        double sum = 0.0;
        for (std::uint64_t seed = 0; seed < 40; seed += 2) {
            const Image a = render_with(loaded.job, 64, seed).film.develop();
            const Image b = render_with(loaded.job, 64, seed + 1).film.develop();
            for (int y = 0; y < 6; ++y)
                for (int x = 0; x < 8; ++x)
                    sum += sqr(static_cast<double>(luminance(a.color(x, y) - b.color(x, y))));
        }
        return std::sqrt(sum);
    };
    const double independent = noise("independent");
    CHECK(noise("stratified") < 0.5 * independent);
    CHECK(noise("sobol") < 0.25 * independent);
}
