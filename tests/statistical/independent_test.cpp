// SPDX-License-Identifier: MIT

// Plumb against another renderer: the scenes of tests/scenes/independent/ and what Mitsuba 3, or quadrature in double
// precision, says of them (references/independent/README.md), by the test of `renderer compare`. Nothing of Plumb went
// into those references, but the reading of the scene files.

#include "build_paths.h"
#include "plumb/compare/compare.h"
#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"
#include "support/statistics.h"
#include "support/temp_directory.h"

#include <fmt/format.h>

using namespace plumb;

namespace {

const std::filesystem::path scene_directory =
    std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "independent";
const std::filesystem::path reference_directory =
    std::filesystem::path(PLUMB_SOURCE_DIR) / "references" / "independent";

// What single precision may cost either renderer.
constexpr double relative_rounding = 2e-4;

struct Reference {
    Image image;
    bool is_quadrature = false; // its error is not noise
};

Reference read_reference(const std::string& name)
{
    Reference reference{read_image(reference_directory / (name + ".exr"), false), true};
    for (const auto& [key, value] : Metadata(reference.image.metadata)) {
        if (key != "judge:samples") continue;
        reference.is_quadrature = false;
        reference.image.metadata.emplace_back("plumb:samplesPerPixel",
                                              std::stoi(std::get<std::string>(value)));
    }
    return reference;
}

std::string describe(const Significance& found)
{
    std::string text = fmt::format("{} of {} pixels are not tested", found.untested, found.pixels);
    for (const ScaleTest& scale : found.scales)
        if (scale.largest && scale.largest->p == found.p)
            text += fmt::format("; {} x {} pixels at {} {}, channel {}: {:.6g}, reference {:.6g}",
                                scale.largest->place.width, scale.largest->place.height,
                                scale.largest->place.x, scale.largest->place.y, scale.largest->channel,
                                scale.largest->mean_a, scale.largest->mean_b);
    return text;
}

// undecided_share: so many of the pixels may lie where the samples support no test.
void check_scene(const std::string& name, std::uint64_t samples_per_pixel, double undecided_share,
                 double level)
{
    const LoadedScene scene = load_scene(scene_directory / (name + ".xml"));
    const Reference reference = read_reference(name);
    const auto run = [&](std::uint64_t samples, std::uint64_t seed) {
        RenderOptions how;
        how.samples_per_pixel = samples;
        how.seed = seed;
        const RenderState result = render(scene.job, how);
        CHECK(result.left_out.count == 0);
        Image ours = result.film.develop(Channels::color_and_evidence);
        ours.metadata.emplace_back("plumb:samplesPerPixel", static_cast<int>(samples));

        CompareSettings options;
        options.flip = FlipMode::none;
        options.rounding = relative_rounding;
        if (reference.is_quadrature) options.exact = Side::b;
        const Significance found = compare(ours, reference.image, options).significance;
        const bool is_decided =
            static_cast<double>(found.untested) <= undecided_share * static_cast<double>(found.pixels);
        return test::Outcome{is_decided ? found.p : 0.0, describe(found)}; // else: not enough samples
    };
    test::check_statistic(name, run, samples_per_pixel, level);
}

void check_scenes(std::uint64_t samples_per_pixel, double undecided_share)
{
    const std::vector<std::filesystem::path> scenes = xml_files(scene_directory);
    REQUIRE(scenes.size() >= 40);
    const double level = test::sidak_level(test::significance, scenes.size());
    for (const std::filesystem::path& scene : scenes)
        check_scene(scene.stem().string(), samples_per_pixel, undecided_share, level);
}

} // namespace

TEST_CASE("images have the expectation that the independent judge says", "[statistical][independent]")
{
    check_scenes(192, 0.5);
}

TEST_CASE("images have the expectation that the independent judge says, within a fraction of a percent",
          "[statistical][independent][slow]")
{
    check_scenes(1600, 0.0);
}
