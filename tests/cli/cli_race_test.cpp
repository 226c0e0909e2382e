// SPDX-License-Identifier: MIT

// renderer race.

#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

namespace {

double number_after(const std::string& text, const std::string& words, std::size_t from)
{
    const std::size_t place = text.find(words, from);
    REQUIRE(place != std::string::npos);
    return std::stod(text.substr(place + words.size()));
}

} // namespace

TEST_CASE("the race names the most efficient estimator", "[cli][race]")
{
    const SceneDirectory directory;
    directory.write("easy.xml", easy_scene);
    const RunResult run = directory.run({"race", "easy.xml", "--integrators", "path,path_mis", "--spp", "16",
                                         "--rounds", "20", "--json", "a.json"});
    INFO(run.out << run.err);
    CHECK(run.exit_code == 0);
    CHECK(run.out.starts_with("easy.xml: 20 rounds of 16 samples per pixel\n"));
    CHECK_THAT(run.out, ContainsSubstring("  ms a sample  variance   efficiency\n  path_mis  "));
    CHECK_THAT(run.out, ContainsSubstring("  1\n  path      "));
    CHECK_THAT(run.out, ContainsSubstring("\n  path and path_mis: agree, p "));
    CHECK(run.out.ends_with("\nagree\n"));

    const std::string json = read_bytes(directory / "a.json");
    const std::size_t second = json.find("\"name\": \"path\"");
    CHECK(json.find("\"name\": \"path_mis\"") < second);
    CHECK(number_after(json, "\"efficiency\": ", 0) == 1.0);
    const double efficiency = number_after(json, "\"efficiency\": ", second);
    CHECK(efficiency < 0.5);
    CHECK(number_after(json, "\"efficiency_low\": ", second) < efficiency);
    CHECK(number_after(json, "\"efficiency_high\": ", second) > efficiency);
    CHECK(number_after(json, "\"variance\": ", second) > 4.0 * number_after(json, "\"variance\": ", 0));
    CHECK(number_after(json, "\"seconds_per_sample\": ", second) > 0.0);
}

TEST_CASE("an estimator that finds no light does not win", "[cli][race]")
{
    const SceneDirectory directory;
    directory.write("small.xml", small_lamp_scene());
    const RunResult run = directory.run(
        {"race", "small.xml", "--integrators", "path,path_nee", "--spp", "4", "--rounds", "12"});
    INFO(run.out << run.err);
    CHECK(run.exit_code == 4);
    CHECK_THAT(run.out, ContainsSubstring("  1\n  path      "));
    CHECK_THAT(run.out, ContainsSubstring("  0          unknown: it found no noise\n"));
    CHECK_THAT(run.out, ContainsSubstring("\nundecided\nmore samples may decide it"));
}

TEST_CASE("the variance of a race is that of the images' own error bars", "[cli][race]")
{
    const SceneDirectory directory;
    directory.write("easy.xml", easy_scene);
    const RunResult race = directory.run({"race", "easy.xml", "--integrators", "path_mis,path_nee", "--spp",
                                          "32", "--rounds", "40", "--json", "-"});
    CHECK(race.exit_code == 0);
    const double variance = number_after(race.out, "\"variance\": ", race.out.find("\"name\": \"path_mis\""));
    const RunResult image = directory.run(
        {"easy.xml", "-o", "a.exr", "--spp", "32", "--integrator", "path_mis", "--json", "-", "--quiet"});
    const double rmse = number_after(image.out, "\"rmse\": ", 0);
    // 1296 values, each known to a few hundredths.
    CHECK(std::sqrt(variance) == Approx(rmse).epsilon(0.03));
}

TEST_CASE("estimators that differ have raced for nothing", "[cli][race]")
{
    const SceneDirectory directory;
    directory.write("easy.xml", easy_scene);
    const RunResult run = directory.run(
        {"race", "easy.xml", "--integrators", "path_mis,direct_mis", "--samplers", "independent"});
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.out,
               ContainsSubstring("  path_mis with independent and direct_mis with independent: differs, p "));
    CHECK(run.out.ends_with(
        "\ndiffer: path_mis with independent and direct_mis with independent have no common scene, so "
        "their efficiencies are not comparable (direct_mis with independent: light of more than 1 "
        "surface bounce is omitted)\n"));
}

TEST_CASE("a race takes a time instead of a number of samples", "[cli][race]")
{
    const SceneDirectory directory;
    directory.write("easy.xml", easy_scene);
    const RunResult run = directory.run({"race", "easy.xml", "--time", "1s", "--rounds", "5"});
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, ContainsSubstring("easy.xml: 5 rounds of "));
    CHECK(directory.run({"race", "easy.xml", "--time", "1s", "--spp", "4"}).exit_code == 2);
    CHECK(directory.run({"race", "easy.xml", "--integrators", "path"}).err ==
          "error: race needs two estimators or more; name them with --integrators\n");
    CHECK(directory.run({"race", "easy.xml", "--rounds", "2"}).exit_code == 2);
    CHECK(directory.run({"agree", "easy.xml", "--rounds", "5"}).err ==
          "error: option '--rounds' cannot be used with agree\n");
}
