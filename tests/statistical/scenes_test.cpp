// SPDX-License-Identifier: MIT

// The project's own scenes: path, path_nee and path_mis converge to the same picture, and the pictures of references/
// are what they converge to.

#include "support/catch.h"
#include "support/statistics.h"

#include "plumb/scene_file.h"

#include <fmt/format.h>

using namespace plumb;

namespace {

const std::filesystem::path root = PLUMB_SOURCE_DIR;

LoadedScene load_small(const std::string& scene, const std::string& integrator)
{
    LoadOptions options;
    options.integrator = integrator;
    options.resolution = Vec2i(24, 18);
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

// The mean of a whole picture, as many times as there are replicates with seeds of their own.
constexpr std::uint64_t replicates = 24;

MeanAndVariance picture_means(const RenderJob& job, std::uint64_t samples_per_pixel, std::uint64_t seed)
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
                    return test::same_mean_outcome(picture_means(other.job, samples, seed),
                                                   picture_means(mis.job, samples, seed + 50));
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

TEST_CASE("the references are what the scenes converge to", "[statistical][scenes][slow]")
{
    struct Reference {
        const char* picture;
        const char* scene;
        std::uint64_t samples_per_pixel; // of the picture
    };
    const std::vector<Reference> references = {
        {"cbox/cbox", "cbox/cbox_mis.xml", 1024},
        {"cbox/cbox_glossy", "cbox/cbox_glossy_mis.xml", 1024},
        {"cbox/cbox_caustics", "cbox/cbox_caustics_mis.xml", 2048},
        {"veach_mi/veach", "veach_mi/veach_mis.xml", 1024},
        {"table/table", "table/table_mis.xml", 1024},
        {"hw4/rectangle", "hw4/cornellbox_mesh.xml", 1024},
    };
    for (const Reference& reference : references) {
        const Image picture =
            read_image(root / "references" / (std::string(reference.picture) + ".exr"), false);
        const double expected = mean_luminance(picture);
        LoadOptions options;
        options.integrator = "path_mis";
        options.resolution = Vec2i(picture.full_width(), picture.full_height());
        const LoadedScene scene = load_scene(root / "scenes" / reference.scene, options);
        CHECK(test::check_statistic(
            reference.picture,
            [&](std::uint64_t samples, std::uint64_t seed) {
                // The reference is one picture of so many samples: its own noise is that of a replicate, by the ratio.
                const MeanAndVariance means = picture_means(scene.job, samples, seed);
                const double share =
                    static_cast<double>(samples) / static_cast<double>(reference.samples_per_pixel);
                const double variance = means.variance() * (1.0 / static_cast<double>(replicates) + share);
                const double t = (means.mean() - expected) / std::sqrt(variance);
                return test::Outcome{test::student_t_two_sided(t, static_cast<double>(replicates - 1)),
                                     fmt::format("mean {} against {}, t = {}", means.mean(), expected, t)};
            },
            1, test::sidak_level(test::significance, references.size())));
    }
}
