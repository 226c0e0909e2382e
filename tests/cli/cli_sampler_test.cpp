// SPDX-License-Identifier: MIT

// What the samplers' promises are on the command line: sobol goes on and merges as independent does, with error bars that
// are upper bounds and say so; stratified has one total, and refuses what goes past it.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

namespace {

RunResult run_with(const SceneDirectory& directory, const std::string& sampler, const Names& words)
{
    Names all = {"scene.xml", "--size", "16x12", "--sampler", sampler};
    all.insert(all.end(), words.begin(), words.end());
    return directory.run(all);
}

const std::string total_has_changed = "the sampler's total number of samples was ";

} // namespace

TEST_CASE("--sampler takes the scene's number of samples, and error bars say what they are", "[cli][sampler]")
{
    const SceneDirectory directory;
    for (const std::string sampler : {"sobol", "stratified"}) {
        const RunResult result = run_with(directory, sampler, {"-o", "a.exr", "--json", "a.json"});
        REQUIRE(result.exit_code == 0);
        CHECK_THAT(result.err, ContainsSubstring("noise: rmse at most "));
        CHECK_THAT(read_bytes(directory / "a.json"), ContainsSubstring("\"upper_bound\": true"));
        const auto found = header(directory / "a.exr");
        CHECK(text(found, "plumb:sampler") == sampler);
        CHECK(text(found, "plumb:errorBars") == "upper bounds");
        CHECK(integer(found, "plumb:samplesPerPixel") == 4);
        CHECK(found.count("plumb:samplerTotal") == (sampler == "stratified" ? 1 : 0));
    }
    const RunResult independent = run_with(directory, "independent", {"-o", "a.exr", "--json", "a.json"});
    CHECK_THAT(independent.err, ContainsSubstring("noise: rmse ") && !ContainsSubstring("at most"));
    CHECK_THAT(read_bytes(directory / "a.json"), ContainsSubstring("\"upper_bound\": false"));
    CHECK(header(directory / "a.exr").count("plumb:errorBars") == 0);
}

TEST_CASE("sobol resumes to any number of samples", "[cli][sampler][checkpoint]")
{
    const SceneDirectory directory;
    REQUIRE(run_with(directory, "sobol", {"-o", "whole.exr", "--spp", "21"}).exit_code == 0);
    REQUIRE(run_with(directory, "sobol", {"-o", "a.exr", "--spp", "5", "--checkpoint", "c.exr"}).exit_code ==
            0);
    REQUIRE(run_with(directory, "sobol", {"-o", "a.exr", "--spp", "21", "--checkpoint", "c.exr", "--resume"})
                .exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));
    REQUIRE(directory.run({"rerun", "a.exr", "-o", "again.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "again.exr") == read_bytes(directory / "whole.exr"));
}

TEST_CASE("parts by any sampler make the image", "[cli][sampler][merge]")
{
    const SceneDirectory directory;
    const std::string sampler = GENERATE(as<std::string>{}, "sobol", "stratified");
    const std::string by = GENERATE(as<std::string>{}, "tiles", "samples");
    REQUIRE(run_with(directory, sampler, {"-o", "whole.exr", "--spp", "11"}).exit_code == 0);
    for (const std::string part : {"1", "2", "3"})
        REQUIRE(run_with(directory, sampler,
                         {"--spp", "11", "--part", part + "/3", "--part-by", by, "-o", part + ".exr"})
                    .exit_code == 0);
    REQUIRE(directory.run({"merge", "3.exr", "1.exr", "2.exr", "-o", "merged.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "merged.exr") == read_bytes(directory / "whole.exr"));
}

TEST_CASE("an image by stratified is not resumed past its total", "[cli][sampler][checkpoint]")
{
    const SceneDirectory directory;
    REQUIRE(
        run_with(directory, "stratified", {"-o", "a.exr", "--spp", "4", "--checkpoint", "c.exr"}).exit_code ==
        0);
    const auto refusal = [&](const Names& words) {
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 1);
        return result.err;
    };
    const Names more = {"scene.xml",    "--size", "16x12",    "--sampler", "stratified", "--spp",  "9",
                        "--checkpoint", "c.exr",  "--resume", "-o",        "b.exr",      "--quiet"};
    CHECK(refusal(more) == "error: cannot resume from 'c.exr': " + total_has_changed + "4 and is 9\n");

    REQUIRE(run_with(directory, "stratified", {"--spp", "4", "--part", "1/2", "-o", "p.exr"}).exit_code == 0);
    REQUIRE(run_with(directory, "stratified", {"--spp", "9", "--part", "2/2", "-o", "q.exr"}).exit_code == 0);
    CHECK(refusal({"merge", "p.exr", "q.exr", "-o", "m.exr"}) ==
          "error: 'p.exr' and 'q.exr' are not parts of one image: " + total_has_changed + "4 and is 9\n");

    CHECK(refusal({"scene.xml", "--sampler", "stratified", "--time", "1", "-o", "t.exr", "--quiet"}) ==
          "error: the sampler 'stratified' depends on the total number of samples per pixel: with --time or "
          "--target-error, give the maximum with --spp, or use --sampler sobol\n");
    CHECK(run_with(directory, "stratified", {"--time", "1h", "--spp", "3", "-o", "t.exr"}).exit_code == 0);

    CHECK(refusal({"replay", "scene.xml", "--sampler", "stratified", "--pixel", "1,1", "--sample", "4",
                   "--quiet"}) == "error: sample 4 was requested, but the sampler has a total of 4 samples "
                                  "per pixel; give the total with --spp\n");
}

TEST_CASE("samplers agree", "[cli][sampler][agree]")
{
    const SceneDirectory directory;
    std::string scene = small_scene();
    const std::string glass = "dielectric"; // whose caustic is found by too few of these samples
    directory.write("scene.xml", scene.replace(scene.find(glass), glass.size(), "diffuse"));
    const RunResult result =
        directory.run({"agree", "scene.xml", "--integrators", "path_mis", "--samplers",
                       "independent,sobol,stratified", "--size", "16x12", "--spp", "128"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out,
               ContainsSubstring("  path_mis with sobol and path_mis with stratified: agree, p "));
}
