// SPDX-License-Identifier: MIT

// --adaptive: each pixel decides how many samples it gets, and the law holds.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "support/catch.h"

#include <map>

using namespace plumb;

namespace {

// By an integrator that finds the lamp now and then, so that pixels differ.
RunResult run_with(const SceneDirectory& directory, const Names& words)
{
    Names all = {"scene.xml", "--size", "16x12", "--integrator", "path_mats"};
    all.insert(all.end(), words.begin(), words.end());
    return directory.run(all);
}

void render(const SceneDirectory& directory, const Names& words)
{
    const RunResult result = run_with(directory, words);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
}

const Names adaptive = { // 128 samples usually, 64 at least
    "--spp", "256", "--adaptive", "0.1"};

Names with(Names words, const Names& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

float value(const Image& image, const std::string& channel, int x, int y)
{
    const std::vector<std::string>& names = image.channel_names();
    const auto at = std::find(names.begin(), names.end(), channel);
    REQUIRE(at != names.end());
    return image.pixel(x, y)[at - names.begin()];
}

} // namespace

TEST_CASE("a pixel of an adaptive image is that of a plain one with as many samples", "[cli][adaptive]")
{
    const SceneDirectory directory;
    render(directory, with(adaptive, {"-o", "a.exr", "--aov", "rays"}));
    const Image image = read_image(directory / "a.exr", false);
    std::map<int, Image> plain;
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 16; ++x) {
            const int samples = static_cast<int>(value(image, "samples", x, y));
            if (!plain.contains(samples)) {
                const std::string file = std::to_string(samples) + ".exr";
                render(directory, {"-o", file, "--spp", std::to_string(samples), "--aov", "rays"});
                plain.emplace(samples, read_image(directory / file, false));
            }
            for (const std::string& channel : plain.at(samples).channel_names())
                REQUIRE(value(image, channel, x, y) == value(plain.at(samples), channel, x, y));
        }
    }
    CHECK(plain.size() >= 2);
    for (const auto& [samples, unused] : plain) CHECK((samples & (samples - 1)) == 0);
    const ImageHeader found = header(directory / "a.exr");
    CHECK(text(found, "plumb:adaptive") == "0.1");
    CHECK(text(found, "plumb:set.adaptive") == "0.1");
    CHECK(integer(found, "plumb:samplesPerPixel") == plain.begin()->first);
    CHECK(integer(found, "plumb:mostSamplesPerPixel") == plain.rbegin()->first);
    CHECK(text(found, "plumb:samplesTaken") == "0,0,16,12:0-256");
    CHECK(integer(found, "plumb:biased") == 0);
}

TEST_CASE("adaptive images have the same bytes by threads, parts, checkpoints and again", "[cli][adaptive]")
{
    const SceneDirectory directory;
    render(directory, with(adaptive, {"-o", "whole.exr", "--threads", "1"}));
    const std::string whole = read_bytes(directory / "whole.exr");
    render(directory, with(adaptive, {"-o", "three.exr", "--threads", "3"}));
    CHECK(read_bytes(directory / "three.exr") == whole);

    for (const std::string part : {"1", "2", "3"})
        render(directory, with(adaptive, {"--part", part + "/3", "-o", part + ".exr"}));
    REQUIRE(directory.run({"merge", "3.exr", "1.exr", "2.exr", "-o", "merged.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "merged.exr") == whole);

    // Smaller maxima, of which only the last needs pilots, and then more.
    for (const std::string samples : {"5", "16", "100"})
        render(directory, {"--spp", samples, "--adaptive", "0.1", "--checkpoint", "c.exr", "--resume", "-o",
                           "part.exr"});
    render(directory, with(adaptive, {"--checkpoint", "c.exr", "--resume", "-o", "resumed.exr"}));
    CHECK(read_bytes(directory / "resumed.exr") == whole);

    REQUIRE(directory.run({"rerun", "whole.exr", "-o", "again.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "again.exr") == whole);

    render(directory, with(adaptive, {"--crop", "5,3,7,6", "-o", "crop.exr"}));
    const Image image = read_image(directory / "whole.exr", false);
    const Image crop = read_image(directory / "crop.exr", false);
    REQUIRE(crop.data_window() == PixelRect{5, 3, 7, 6});
    for (int y = 3; y < 9; ++y)
        for (int x = 5; x < 12; ++x)
            for (const std::string& channel : image.channel_names())
                REQUIRE(value(image, channel, x, y) == value(crop, channel, x, y));
}

TEST_CASE("an adaptive rendering says how many samples its pixels have", "[cli][adaptive]")
{
    const SceneDirectory directory;
    const RunResult result = run_with(directory, with(adaptive, {"-o", "a.exr", "--json", "a.json"}));
    REQUIRE(result.exit_code == 0);
    CHECK_THAT(result.err, ContainsSubstring("adaptive: 64 to 256 samples per pixel, "));
    const std::string json = read_bytes(directory / "a.json");
    CHECK_THAT(json, ContainsSubstring("\"adaptive\": {\n    \"target\": 0.1,\n    \"least_spp\": 64,\n"
                                       "    \"most_spp\": 256,\n    \"mean_spp\": "));
    // No word of it where it is off.
    render(directory, {"-o", "plain.exr", "--spp", "16", "--json", "plain.json", "--checkpoint", "c.exr"});
    CHECK_THAT(read_bytes(directory / "plain.json"), !ContainsSubstring("adaptive"));
    for (const char* file : {"plain.exr", "c.exr"}) {
        const Image image = read_image(directory / file, false);
        const std::vector<std::string>& names = image.channel_names();
        CHECK(std::find(names.begin(), names.end(), "samples") == names.end());
        CHECK(std::find(names.begin(), names.end(), "plan") == names.end());
        for (const auto& [name, unused] : header(directory / file)) {
            CHECK_THAT(name, !ContainsSubstring("adaptive"));
            CHECK_THAT(name, !ContainsSubstring("Plans"));
        }
    }
}

TEST_CASE("what does not go with --adaptive", "[cli][adaptive]")
{
    const SceneDirectory directory;
    const auto usage = [&](const Names& words) {
        const RunResult result = directory.run(with({"scene.xml", "-o", "x.exr"}, words));
        CHECK(result.exit_code == 2);
        return result.err;
    };
    const std::string rule = "error: --adaptive decides the number of samples of each pixel: give the "
                             "maximum with --spp, not with --time or --target-error\n";
    CHECK(usage({"--adaptive", "0.1", "--time", "1"}) == rule);
    CHECK(usage({"--adaptive", "0.1", "--target-error", "0.1"}) == rule);
    CHECK(usage({"--adaptive", "0.1", "--part", "1/2", "--part-by", "samples"}) ==
          "error: --part-by samples and --adaptive cannot be used together: each part would take the pilot "
          "of every pixel again; use --part-by tiles\n");
    CHECK(usage({"--adaptive", "0"}) == "error: --adaptive must be a number from 0.0001 to 1, not '0'\n");

    const auto refusal = [&](const Names& words) {
        const RunResult result = run_with(directory, with({"--quiet", "-o", "x.exr"}, words));
        CHECK(result.exit_code == 1);
        return result.err;
    };
    CHECK(refusal({"--adaptive", "0.1", "--sampler", "stratified"}) ==
          "error: the sampler 'stratified' depends on the total number of samples per pixel: with "
          "--adaptive, use --sampler sobol\n");

    const auto refused_states = [&](const Names& first, const Names& second, const std::string& change) {
        for (const char* file : {"c.exr", "c.previous.exr", "p.exr", "q.exr", "p.previous.exr"})
            std::filesystem::remove(directory / file);
        render(directory, with(first, {"--spp", "32", "-o", "a.exr", "--checkpoint", "c.exr"}));
        CHECK(refusal(with(second, {"--spp", "32", "--checkpoint", "c.exr", "--resume"})) ==
              "error: cannot resume from 'c.exr': " + change + "\n");
        render(directory, with(first, {"--spp", "32", "--part", "1/2", "-o", "p.exr"}));
        render(directory, with(second, {"--spp", "32", "--part", "2/2", "-o", "q.exr"}));
        const RunResult merged = directory.run({"merge", "p.exr", "q.exr", "-o", "m.exr"});
        CHECK(merged.exit_code == 1);
        CHECK(merged.err == "error: 'p.exr' and 'q.exr' are not parts of one image: " + change + "\n");
    };
    refused_states({"--adaptive", "0.1"}, {"--adaptive", "0.2"}, "--adaptive was 0.1 and is 0.2");
    refused_states({}, {"--adaptive", "0.2"}, "--adaptive was none and is 0.2");
}
