// SPDX-License-Identifier: MIT

// The project's own scenes: path, path_nee and path_mis converge to the same image. That the images of references/ are
// what they converge to is tested by regression/suite.xml.

#include "build_paths.h"
#include "support/catch.h"
#include "support/statistics.h"

#include "plumb/scene_file/scene_file.h"

#include <fmt/format.h>

using namespace plumb;

namespace {

const std::filesystem::path root = PLUMB_SOURCE_DIR;

LoadedScene load_small(const std::string& scene, const std::string& integrator)
{
    RenderSettings options;
    options.method.integrator = integrator;
    options.view.size = Vec2i(24, 18);
    return load_scene(root / "scenes" / scene, options);
}

double mean_luminance(const Image& image)
{
    const PixelRect& window = image.data_window();
    MeanAndVariance mean;
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x) mean.add(luminance(image.color(x, y)));
    return mean.mean();
}

// The mean of a whole image, as many times as there are replicates with seeds of their own.
constexpr std::uint64_t replicates = 24;

MeanAndVariance image_means(const RenderJob& job, std::uint64_t samples_per_pixel, std::uint64_t seed)
{
    MeanAndVariance means;
    for (std::uint64_t i = 0; i < replicates; ++i) {
        RenderOptions options;
        options.samples_per_pixel = samples_per_pixel;
        options.seed = seed * 1000 + i;
        means.add(mean_luminance(render(job, options).film.develop()));
    }
    return means;
}

void check_agreement(const std::vector<std::string>& scenes, std::uint64_t samples_per_pixel)
{
    const double level = test::sidak_level(test::significance, 2 * scenes.size());
    for (const std::string& scene : scenes) {
        const LoadedScene mis = load_small(scene, "path_mis");
        for (const char* other_name : {"path", "path_nee"}) {
            const LoadedScene other = load_small(scene, other_name);
            const std::string name = fmt::format("{}: {} and path_mis", scene, other_name);
            CHECK(test::check_statistic(
                name,
                [&](std::uint64_t samples, std::uint64_t seed) {
                    return test::same_mean_outcome(image_means(other.job, samples, seed),
                                                   image_means(mis.job, samples, seed + 50));
                },
                samples_per_pixel, level));
        }
    }
}

} // namespace

TEST_CASE("the three integrators agree on the Cornell boxes", "[statistical][scenes]")
{
    check_agreement({"cbox/cbox_mis.xml", "cbox/cbox_glossy_mis.xml", "cbox/cbox_caustics_mis.xml"}, 12);
}

TEST_CASE("the three integrators agree on every scene", "[statistical][scenes][slow]")
{
    check_agreement({"cbox/cbox_mis.xml", "cbox/cbox_glossy_mis.xml", "cbox/cbox_caustics_mis.xml",
                     "veach_mi/veach_mis.xml", "table/table_mis.xml", "hw4/cornellbox.xml",
                     "hw4/cornellbox_rectangle.xml", "hw4/cornellbox_mesh.xml",
                     "interesting/interesting_1.xml", "interesting/interesting_2.xml"},
                    120);
}
