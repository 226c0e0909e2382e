// SPDX-License-Identifier: MIT

// renderer agree.

#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

TEST_CASE("estimators of the same light agree", "[cli][agree]")
{
    const SceneDirectory directory;
    directory.write("easy.xml", easy_scene);
    const RunResult run = directory.run({"agree", "easy.xml", "--json", "a.json"});
    INFO(run.out << run.err);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, ContainsSubstring("easy.xml\n  path: 64 samples per pixel\n  path_nee: 64"));
    for (const char* pair :
         {"  path and path_nee: agree, p ", "  path and path_mis: agree, p ",
          "  path_nee and path_mis: agree, p ", " % would have been found with 90 % probability\n",
          "\n"
          "agree; errors shared by all estimators cannot be detected\n"})
        CHECK_THAT(run.out, ContainsSubstring(pair));
    const std::string json = read_bytes(directory / "a.json");
    CHECK_THAT(json, ContainsSubstring("\"verdict\": \"agree\""));
    CHECK_THAT(json, ContainsSubstring("\"detectable_bias\": 0.0"));
    // Another seed is another set of images, and the verdict stands.
    CHECK(directory.run({"agree", "easy.xml", "--seed", "77", "--quiet"}).exit_code == 0);
}

TEST_CASE("an estimator that leaves light out does not agree", "[cli][agree]")
{
    const SceneDirectory directory;
    directory.write("easy.xml", easy_scene);
    const RunResult run =
        directory.run({"agree", "easy.xml", "--integrators", "path_mis,path_nee,direct_mis", "--json", "-"});
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.out, ContainsSubstring("\"verdict\": \"differ\""));
    CHECK_THAT(run.out, ContainsSubstring("\"b\": \"path_nee\",\n      \"outcome\": \"passes\""));
    CHECK_THAT(run.out, ContainsSubstring("\"b\": \"direct_mis\",\n      \"outcome\": \"differs\""));
}

TEST_CASE("too few samples decide nothing", "[cli][agree]")
{
    const SceneDirectory directory;
    const RunResult run = directory.run({"agree", "scene.xml", "--spp", "2", "--size", "12x9"});
    CHECK(run.exit_code == 4);
    CHECK_THAT(run.out, ContainsSubstring("undecided; errors shared by all estimators"));
    CHECK_THAT(run.out, ContainsSubstring("\nmore samples may decide it\n"));
}

TEST_CASE("an estimator that rarely finds the lamp is named", "[cli][agree]")
{
    const SceneDirectory directory;
    directory.write("small.xml", small_lamp_scene());
    const RunResult run = directory.run({"agree", "small.xml", "--json", "a.json"});
    INFO(run.out << run.err);
    CHECK(run.exit_code == 4);
    CHECK_THAT(run.out, ContainsSubstring("  path_nee and path_mis: agree, p "));
    CHECK_THAT(run.out,
               ContainsSubstring(
                   "\n"
                   "more samples may decide it; or omit path, which finds some of the light too rarely\n"));
    CHECK_THAT(read_bytes(directory / "a.json"),
               ContainsSubstring("\"reason\": \"432 of 432 pixels lie in no "));
    CHECK(directory.run({"agree", "small.xml", "--integrators", "path_nee,path_mis"}).exit_code == 0);

    // Many pixels may stay undecided, but not all.
    const RunResult tolerant = directory.run({"agree", "small.xml", "--fail-percent", "100"});
    CHECK(tolerant.exit_code == 4);
    CHECK_THAT(tolerant.out,
               ContainsSubstring("(432 of 432 pixels lie in no square where the samples support a test)\n"));
}

TEST_CASE("agree takes a time instead of a number of samples", "[cli][agree]")
{
    const SceneDirectory directory;
    directory.write("easy.xml", easy_scene);
    CHECK(directory.run({"agree", "easy.xml", "--time", "1s", "--quiet"}).exit_code == 0);
    CHECK(directory.run({"agree", "easy.xml", "--time", "1s", "--spp", "4"}).exit_code == 2);
    CHECK(directory.run({"agree", "easy.xml", "--time", "soon"}).err ==
          "error: --time must be a time like 90, 90s, 10m or 2h, not 'soon'\n");
    CHECK(directory.run({"agree", "easy.xml", "--integrators", "path"}).err ==
          "error: agree needs two estimators or more; name them with --integrators\n");
    CHECK(directory.run({"agree", "easy.xml", "--integrators", "path,,path_nee"}).exit_code == 2);
    CHECK(directory.run({"agree", "easy.xml", "--integrators", "path,paht"}).exit_code != 0);
}

TEST_CASE("black images are no agreement, but the same images", "[cli][agree]")
{
    const SceneDirectory directory;
    std::string dark = easy_scene;
    const std::string lamp = R"(value="1,1,1")";
    dark.replace(dark.find(lamp), lamp.size(), R"(value="0,0,0")");
    directory.write("dark.xml", dark);
    const RunResult run = directory.run({"agree", "dark.xml", "--spp", "4"});
    INFO(run.out << run.err);
    CHECK(run.exit_code == 4);
    CHECK_THAT(run.out,
               ContainsSubstring("undecided, p 1 (both images are black: no sample has found any light)"));
    // Whatever may stay undecided.
    CHECK(directory.run({"agree", "dark.xml", "--spp", "4", "--fail-percent", "100"}).exit_code == 4);
    CHECK(directory.run({"race", "dark.xml", "--spp", "4", "--rounds", "3"}).exit_code == 4);

    REQUIRE(directory.run({"dark.xml", "--integrator", "path", "-o", "a.exr", "--spp", "4", "--quiet"})
                .exit_code == 0);
    const RunResult same = directory.run({"compare", "a.exr", "a.exr"});
    CHECK(same.exit_code == 0);
    CHECK_THAT(same.out, ContainsSubstring("every pixel is the same in both"));
}
