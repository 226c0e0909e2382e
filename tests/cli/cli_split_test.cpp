// SPDX-License-Identifier: MIT

// --split, with the real program: the layers add up in the file, and checkpoints, parts and merged images carry them.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "support/catch.h"

#include <fmt/format.h>

using namespace plumb;

namespace {

const std::string all_splits = "depth:3,technique,light";

// The sum of the layers whose names begin so, in double precision, rounded to float.
Color sum_of(const Image& image, const std::string& family, int x, int y)
{
    double sum[3] = {};
    const Names& names = image.channel_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!names[i].starts_with(family + ".")) continue;
        const char component = names[i].back();
        sum[component == 'R' ? 0 : component == 'G' ? 1 : 2] += static_cast<double>(image.pixel(x, y)[i]);
    }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

} // namespace

TEST_CASE("the layers of a split add up to the image of the file, bit for bit", "[cli][split]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "plain.exr"}).exit_code == 0);
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--split", all_splits, "--aov", "normal,rays"})
                .exit_code == 0);
    const Image plain = read_image(directory / "plain.exr", false);
    const Image image = read_image(directory / "a.exr", false);
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) {
            REQUIRE(image.color(x, y) == plain.color(x, y));
            for (const char* family : {"by_depth", "by_technique", "by_light"})
                REQUIRE(sum_of(image, family, x, y) == plain.color(x, y));
        }
    const ImageHeader header = plumb::header(directory / "a.exr");
    CHECK(text(header, "plumb:set.split") == all_splits);
    CHECK(text(header, "plumb:ids.light") == "1 shape 'sphere' (scene.xml:22)");

    REQUIRE(directory.run({"rerun", "a.exr", "-o", "again.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "again.exr") == read_bytes(directory / "a.exr"));
}

TEST_CASE("checkpoints and parts carry the layers of a split", "[cli][split]")
{
    const SceneDirectory directory;
    const Names more = {"--split", all_splits, "--aov", "depth"};
    const auto run = [&](Names words) {
        words.insert(words.end(), more.begin(), more.end());
        INFO(words.front());
        REQUIRE(directory.run(words).exit_code == 0);
    };
    run({"scene.xml", "-o", "whole.exr", "--spp", "12", "-t", "2"});
    const std::string whole = read_bytes(directory / "whole.exr");
    run({"scene.xml", "-o", "a.exr", "--spp", "5", "--checkpoint", "c.exr"});
    run({"scene.xml", "-o", "a.exr", "--spp", "12", "--checkpoint", "c.exr", "--resume", "-t", "1"});
    CHECK(read_bytes(directory / "a.exr") == whole);
    for (const std::string by : {"tiles", "samples"}) {
        run({"scene.xml", "-o", by + "1.exr", "--spp", "12", "--part", "1/2", "--part-by", by});
        run({"scene.xml", "-o", by + "2.exr", "--spp", "12", "--part", "2/2", "--part-by", by});
        REQUIRE(directory.run({"merge", by + "2.exr", by + "1.exr", "-o", "merged.exr"}).exit_code == 0);
        CHECK(read_bytes(directory / "merged.exr") == whole);
    }
    run({"scene.xml", "-o", "crop.exr", "--spp", "12", "--crop", "10,8,20,16"});
    const Image cropped = read_image(directory / "crop.exr", false);
    const Image image = read_image(directory / "whole.exr", false);
    for (int y = 8; y < 24; ++y)
        for (int x = 10; x < 30; ++x)
            for (int i = 0; i < image.channel_count(); ++i)
                REQUIRE(cropped.pixel(x, y)[i] == image.pixel(x, y)[i]);

    const RunResult refused = directory.run(
        {"scene.xml", "-o", "a.exr", "--checkpoint", "c.exr", "--resume", "--quiet", "--split", "depth"});
    CHECK(refused.exit_code == 1);
    CHECK_THAT(refused.err,
               ContainsSubstring("error: cannot resume from 'c.exr': it has the layers depth, by_depth.0, "));
}

TEST_CASE("a split that cannot be is an error", "[cli][split]")
{
    const SceneDirectory directory;
    const RunResult unknown = directory.run({"scene.xml", "-o", "a.exr", "--split", "colour"});
    CHECK(unknown.exit_code == 2);
    CHECK(unknown.err == "error: --split: unknown split 'colour'; known are depth, technique and light\n");
    const RunResult normals =
        directory.run({"scene.xml", "-o", "a.exr", "--split", "depth", "--integrator", "normals"});
    CHECK(normals.exit_code == 1);
    CHECK_THAT(normals.err,
               ContainsSubstring("error: --split needs an integrator that follows light from emitters"));
    const RunResult many = directory.run({"scene.xml", "-o", "a.exr", "--split", "depth:63,technique"});
    CHECK(many.exit_code == 1);
    CHECK_THAT(many.err, ContainsSubstring("error: a film has at most 64 layers, not 67"));
    const RunResult twice =
        directory.run({"scene.xml", "-o", "a.exr", "--split", "depth", "--aov", "by_depth.0:normal"});
    CHECK(twice.exit_code == 1);
    CHECK_THAT(twice.err, ContainsSubstring("error: two layers are called 'by_depth.0'"));
}

TEST_CASE("compare tests a part of the light", "[cli][split][compare]")
{
    const SceneDirectory directory;
    const std::string scene = easy_scene;
    const std::size_t start = scene.find("<sampler");
    directory.write("deep.xml", std::string(scene).insert(start, R"(<integrator type="path_mis"/>)"));
    directory.write(
        "shallow.xml",
        std::string(scene).insert(
            start, R"(<integrator type="path_mis"><integer name="maxDepth" value="1"/></integrator>)"));
    REQUIRE(directory.run({"deep.xml", "-o", "a.exr", "--spp", "64", "--split", "depth:2"}).exit_code == 0);
    REQUIRE(directory.run({"shallow.xml", "-o", "b.exr", "--spp", "64", "--seed", "1", "--split", "depth:2"})
                .exit_code == 0);
    CHECK(directory.run({"compare", "a.exr", "b.exr", "--layer", "by_depth.1"}).exit_code == 0);
    CHECK(directory.run({"compare", "a.exr", "b.exr"}).exit_code == 3);
}

TEST_CASE("--aov rays counts what a sample costs", "[cli][aov]")
{
    const SceneDirectory directory;
    const RunResult run =
        directory.run({"scene.xml", "-o", "a.exr", "--aov", "rays", "--spp", "16", "--json", "-"});
    REQUIRE(run.exit_code == 0);
    const Image image = read_image(directory / "a.exr", false);
    const Names& names = image.channel_names();
    const auto channel = std::find(names.begin(), names.end(), "rays.N") - names.begin();
    double sum = 0.0;
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) sum += static_cast<double>(image.pixel(x, y)[channel]);
    double rays = 0.0;
    for (const char* kind : {"\"camera\": ", "\"bounce\": ", "\"shadow\": "})
        rays += std::stod(run.out.substr(run.out.find(kind) + 10));
    CHECK(16.0 * sum == Approx(rays).epsilon(1e-6));
}
