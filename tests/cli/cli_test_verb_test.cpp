// SPDX-License-Identifier: MIT

// `renderer test`.

#include "build_paths.h"
#include "support/catch.h"
#include "support/run.h"

using namespace plumb;

namespace {

const std::filesystem::path course = std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "course";

RunResult run_tests_of(std::vector<std::string> words)
{
    words.insert(words.begin(), "test");
    return run_renderer(words, course);
}

} // namespace

TEST_CASE("test prints a line a test and counts them", "[cli][test_verb]")
{
    const RunResult result = run_tests_of({"point_light.xml", "bsdf_means.xml"});
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.out, ContainsSubstring("point_light.xml: ttest, 1.00 k samples each, level 0.01\n"
                                             "  scene (line 6), direct: mean 0.159155 +- "));
    CHECK_THAT(result.out, ContainsSubstring(", reference 0.159155, p 0.9"));
    CHECK_THAT(result.out,
               ContainsSubstring("Passed 1/1 tests.\nbsdf_means.xml: ttest, 50.0 k samples each"));
    CHECK_THAT(result.out, ContainsSubstring("  bsdf 'mirror' (line 9) at 10 degrees: mean 1 +- 0, "
                                             "reference 1, p 1: passed\n"));
    CHECK(result.out.ends_with("Passed 9/9 tests.\nAll 2 files: passed 10/10 tests.\n"));
    CHECK(result.err == "dialect: plumb (set by the scene file)\n");
}

TEST_CASE("a test that fails is repeated, and is exit code 3", "[cli][test_verb]")
{
    const RunResult result = run_tests_of({"wrong_reference.xml"});
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.out, ContainsSubstring(": rejected\n    again with 100 k samples: mean 0.2 "));
    CHECK(result.out.ends_with("Passed 1/2 tests.\n"));
    CHECK(result.err.empty());

    const RunResult quiet = run_tests_of({"--quiet", "wrong_reference.xml", "bsdf_means.xml"});
    CHECK(quiet.exit_code == 3);
    CHECK(quiet.out.empty());
    CHECK(quiet.err.starts_with(
        "error: wrong_reference.xml:\n  bsdf 'diffuse' (line 6) at 45 degrees: mean 0.2 "));
}

TEST_CASE("chi2tests and the options of scenes", "[cli][test_verb]")
{
    const RunResult chi2 = run_tests_of({"chi2.xml", "--seed", "4"});
    CHECK(chi2.exit_code == 0);
    CHECK_THAT(chi2.out, ContainsSubstring("chi2.xml: chi2test, 100 k samples each, level 0.001256\n"));
    CHECK_THAT(chi2.out, ContainsSubstring("of 55 degrees of freedom, p "));
    CHECK(chi2.out.ends_with("Passed 8/8 tests.\n"));

    // Where light ends at emitters, and with another albedo, the references are wrong.
    const RunResult absorbed = run_tests_of({"furnace.xml", "--dialect", "zaragoza"});
    CHECK(absorbed.exit_code == 3);
    CHECK(absorbed.out.ends_with("Passed 0/3 tests.\n"));
    CHECK(absorbed.err == "dialect: zaragoza (set by --dialect)\n");
    const RunResult defined = run_tests_of({"furnace.xml", "-D", "albedo=0.4 0.4 0.4"});
    CHECK(defined.exit_code == 3);
    CHECK(defined.out.ends_with("Passed 1/3 tests.\n"));
}

TEST_CASE("test reports in JSON, the same for any number of threads", "[cli][test_verb]")
{
    const TempFolder folder;
    const auto json = [&](const std::string& threads) {
        const std::string file = (folder / ("report" + threads)).string();
        const RunResult result = run_tests_of({"furnace.xml", "wrong_reference.xml", "chi2.xml", "--json",
                                               file, "--threads", threads, "--seed", "9", "--quiet"});
        CHECK(result.exit_code == 3);
        return read_bytes(file);
    };
    const std::string report = json("1");
    CHECK(report == json("3"));
    for (const char* part :
         {"\"seed\": 9,", "\"file\": \"furnace.xml\",\n      \"type\": \"ttest\"", "\"dialect\": \"epfl\"",
          "\"name\": \"scene (line 8), path_mis\"", "\"reference\": 1.25,", "\"samples\": 100000,",
          "\"degrees_of_freedom\": 99999,", "\"chi2\": ", "\"variance\": ", "\"passed\": false",
          "\"passed\": 3,\n      \"total\": 3"})
        CHECK_THAT(report, ContainsSubstring(part));

    const RunResult printed = run_tests_of({"point_light.xml", "--json", "-"});
    CHECK(printed.out.starts_with("{\n"));
    CHECK(printed.out.ends_with("}\n"));
    CHECK(printed.err.ends_with("Passed 1/1 tests.\n"));
}

TEST_CASE("files that are not tests are all complained of, and nothing runs", "[cli][test_verb]")
{
    const RunResult result =
        run_tests_of({"none.xml", "point_light.xml", "room.obj", "../bad_tests/empty.xml"});
    CHECK(result.exit_code == 1);
    CHECK(result.out.empty());
    CHECK_THAT(result.err, ContainsSubstring("error: test file 'none.xml' does not exist\n"));
    CHECK_THAT(result.err, ContainsSubstring("room.obj: error: this is an OBJ mesh"));
    CHECK_THAT(result.err, ContainsSubstring("../bad_tests/empty.xml:1:1: error: the test has neither"));

    const RunResult nothing = run_tests_of({});
    CHECK(nothing.exit_code == 2);
    CHECK(nothing.err == "error: no test file given; 'renderer --help' shows how\n");
    const RunResult scene = run_renderer({"point_light.xml"}, course);
    CHECK(scene.exit_code == 1);
    CHECK_THAT(scene.err, ContainsSubstring("a <test> file is not a scene; 'renderer test FILE' runs it"));
}
