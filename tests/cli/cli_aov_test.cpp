// SPDX-License-Identifier: MIT

// --aov and compare --layer, with the real program: layers in files, checkpoints, parts and merged images.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "plumb/render/aovs.h"
#include "support/catch.h"
#include "support/random.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

using namespace plumb;

namespace {

std::string joined(const Names& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

// Some of them, at least one, in any order.
Names random_aovs(test::TestRandom& random)
{
    Names names = aov_names();
    for (std::size_t i = names.size(); i-- > 1;)
        std::swap(names[i], names[static_cast<std::size_t>(random.next_double() * double(i + 1))]);
    names.resize(1 + static_cast<std::size_t>(random.next_double() * double(names.size() - 1)));
    return names;
}

bool has(const Image& image, const std::string& channel)
{
    const Names& names = image.channel_names();
    return std::find(names.begin(), names.end(), channel) != names.end();
}

} // namespace

TEST_CASE("an image with AOVs has layers, and the same beauty", "[cli][aov]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "plain.exr", "-o", "plain.png"}).exit_code == 0);
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "-o", "a.png", "--aov", "normal,albedo,depth,object"})
                .exit_code == 0);
    const Image plain = read_image(directory / "plain.exr", false);
    const Image image = read_image(directory / "a.exr", false);
    for (const char* channel : {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z",
                                "depth.Z", "object.id", "variance.R", "contributing"})
        CHECK(has(image, channel));
    CHECK(image.channel_names().size() == plain.channel_names().size() + 8);
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) REQUIRE(image.color(x, y) == plain.color(x, y));
    CHECK(read_image(directory / "a.png", false).channel_count() == 3);

    const ImageHeader header = plumb::header(directory / "a.exr");
    CHECK(text(header, "plumb:set.aov") == "normal,albedo,depth,object");
    CHECK(text(header, "plumb:ids.object") == "1 shape 'rectangle' (scene.xml:10)\n"
                                              "2 shape 'sphere' (scene.xml:14)\n"
                                              "3 shape 'sphere' (scene.xml:18)\n"
                                              "4 shape 'sphere' (scene.xml:22)");
    CHECK(text(header, "plumb:inputHash") == text(plumb::header(directory / "plain.exr"), "plumb:inputHash"));
    CHECK_THAT(directory.run({"info", "a.exr"}).out, ContainsSubstring(" normal.X normal.Y normal.Z"));
    CHECK_THAT(directory.run({"info", "a.exr"}).out, ContainsSubstring("  plumb:ids.object       1 shape"));

    REQUIRE(directory.run({"rerun", "a.exr", "-o", "again.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "again.exr") == read_bytes(directory / "a.exr"));
}

TEST_CASE("an AOV that nobody knows is wrong usage", "[cli][aov]")
{
    const SceneDirectory directory;
    const RunResult result = directory.run({"scene.xml", "-o", "a.exr", "--aov", "normal,color"});
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, ContainsSubstring("error: --aov: unknown AOV 'color'; known are albedo, "));
}

TEST_CASE("checkpoints and parts carry any set of layers, and merge in any order", "[cli][aov]")
{
    test::TestRandom random(21);
    for (int round = 0; round < 4; ++round) {
        const SceneDirectory directory;
        const std::string aovs = joined(random_aovs(random));
        const std::string by = random.next_double() < 0.5 ? "tiles" : "samples";
        CAPTURE(aovs, by);
        REQUIRE(directory.run({"scene.xml", "-o", "whole.exr", "--spp", "12", "--aov", aovs}).exit_code == 0);
        const std::string whole = read_bytes(directory / "whole.exr");

        const Names checkpoint = {"--checkpoint", "c.exr", "--aov", aovs};
        Names first = {"scene.xml", "-o", "a.exr", "--spp", "5"};
        first.insert(first.end(), checkpoint.begin(), checkpoint.end());
        REQUIRE(directory.run(first).exit_code == 0);
        Names second = {"scene.xml", "-o", "a.exr", "--spp", "12", "--resume"};
        second.insert(second.end(), checkpoint.begin(), checkpoint.end());
        REQUIRE(directory.run(second).exit_code == 0);
        CHECK(read_bytes(directory / "a.exr") == whole);

        Names parts;
        for (int part = 1; part <= 3; ++part) {
            parts.push_back(fmt::format("p{}.exr", part));
            REQUIRE(directory
                        .run({"scene.xml", "-o", parts.back(), "--spp", "12", "--aov", aovs, "--part",
                              fmt::format("{}/3", part), "--part-by", by})
                        .exit_code == 0);
        }
        for (const auto& order : {std::array{0, 1, 2}, std::array{2, 0, 1}}) {
            REQUIRE(directory
                        .run({"merge", parts[static_cast<std::size_t>(order[0])],
                              parts[static_cast<std::size_t>(order[1])],
                              parts[static_cast<std::size_t>(order[2])], "-o", "merged.exr"})
                        .exit_code == 0);
            CHECK(read_bytes(directory / "merged.exr") == whole);
        }
    }
}

TEST_CASE("layers that are not those of the checkpoint or of another part are refused", "[cli][aov]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--checkpoint", "c.exr", "--aov", "normal,depth"})
                .exit_code == 0);
    const auto refusal = [&](const Names& more) {
        Names words = {"scene.xml", "-o", "b.exr", "--checkpoint", "c.exr", "--resume", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 1);
        return result.err;
    };
    CHECK(refusal({}) == "error: cannot resume from 'c.exr': it has the layers normal, depth, and --aov and "
                         "--split ask for none\n");
    CHECK(refusal({"--aov", "albedo"}) == "error: cannot resume from 'c.exr': it has the layers normal, "
                                          "depth, and --aov and --split ask for albedo\n");

    REQUIRE(directory.run({"scene.xml", "-o", "p1.exr", "--part", "1/2", "--aov", "uv"}).exit_code == 0);
    REQUIRE(directory.run({"scene.xml", "-o", "p2.exr", "--part", "2/2"}).exit_code == 0);
    const RunResult merged = directory.run({"merge", "p1.exr", "p2.exr", "-o", "m.exr"});
    CHECK(merged.exit_code == 1);
    CHECK(merged.err ==
          "error: 'p1.exr' and 'p2.exr' are not parts of one image: one has the layers uv, the other "
          "none\n");
}

TEST_CASE("compare --layer compares a layer", "[cli][aov][compare]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--aov", "albedo,depth,uv"}).exit_code == 0);
    REQUIRE(
        directory.run({"scene.xml", "-o", "b.exr", "--aov", "albedo,depth,uv", "--seed", "1"}).exit_code ==
        0);
    CHECK(directory.run({"compare", "a.exr", "a.exr", "--layer", "depth"}).exit_code == 0);
    const RunResult depth =
        directory.run({"compare", "a.exr", "b.exr", "--layer", "depth", "--max", "rmse=10"});
    CHECK(depth.exit_code == 0);
    CHECK_THAT(depth.out, ContainsSubstring("channel depth.Z\n"));
    CHECK(directory.run({"compare", "a.exr", "b.exr", "--layer", "uv", "--max", "rmse=1e-9"}).exit_code == 3);
    CHECK(directory
              .run({"compare", "a.exr", "b.exr", "--layer", "albedo", "--diff", "d.png", "--max", "rmse=1"})
              .exit_code == 0);
    const RunResult none = directory.run({"compare", "a.exr", "b.exr", "--layer", "normal"});
    CHECK(none.exit_code == 1);
    CHECK(none.err == "error: A has no layer 'normal'; it has albedo, depth, uv, variance\n");
}
