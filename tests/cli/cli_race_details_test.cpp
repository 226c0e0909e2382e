// SPDX-License-Identifier: MIT

// renderer race --out: curves and maps, and other programs in the race.

#include "cli/small_scene.h"
#include "plumb/image/image.h"
#include "support/catch.h"

#include <cmath>
#include <map>
#include <sstream>

using namespace plumb;

namespace {

struct Row {
    double seconds = 0.0, rmse = 0.0, low = 0.0, high = 0.0;
};
using Curve = std::map<int, Row>; // by the number of samples

std::map<std::string, Curve> curves_in(const std::filesystem::path& csv)
{
    std::istringstream text(read_bytes(csv));
    std::string line;
    REQUIRE(std::getline(text, line));
    REQUIRE(line == "estimator,samples_per_pixel,seconds,rmse,rmse_low,rmse_high,images");
    std::map<std::string, Curve> curves;
    while (std::getline(text, line)) {
        const std::size_t end = line.find('"', 1);
        std::vector<double> numbers;
        std::istringstream rest(line.substr(end + 2));
        for (std::string word; std::getline(rest, word, ',');)
            numbers.push_back(word.empty() ? 0.0 : std::stod(word));
        REQUIRE(numbers.size() == 6);
        curves[line.substr(1, end - 1)][int(numbers[0])] = {numbers[1], numbers[2], numbers[3], numbers[4]};
    }
    return curves;
}

struct RaceDirectory : SceneDirectory {
    RaceDirectory() { write("easy.xml", easy_scene); }
    RunResult race(Names words) const
    {
        words.insert(words.begin(), {"race", "easy.xml", "--out", "out"});
        return run(words);
    }
};

const std::string plumb_command =
    std::string(PLUMB_RENDERER) +
    " {scene} -o {image} --seed {seed} --spp {spp} --size {width}x{height} --no-variance "
    "--quiet --integrator ";

} // namespace

TEST_CASE("race --out writes how the error falls", "[cli][race]")
{
    const RaceDirectory directory;
    const RunResult run =
        directory.race({"--integrators", "path_mis", "--samplers", "independent,stratified,sobol", "--spp",
                        "48", "--rounds", "24", "--json", "r.json"});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.ends_with("\nagree\ncurves: out/convergence.svg\n"));
    const std::map<std::string, Curve> curves = curves_in(directory / "out/convergence.csv");
    REQUIRE(curves.size() == 3);
    for (const auto& [name, curve] : curves) {
        CAPTURE(name);
        REQUIRE(curve.size() == 7); // 1, 2, 4, ..., 32, 48
        for (const auto& [samples, row] : curve) {
            CHECK(row.low < row.rmse);
            CHECK(row.rmse < row.high);
        }
    }
    // Independent samples: 1 / sqrt(n). The images of 24 rounds have 31,104 values.
    const Curve& independent = curves.at("path_mis with independent");
    for (const auto& [samples, row] : independent)
        CHECK(row.rmse * std::sqrt(samples) == Approx(independent.at(1).rmse).epsilon(0.05));
    CHECK(curves.at("path_mis with sobol").at(32).rmse < 0.7 * independent.at(32).rmse);
    CHECK(curves.at("path_mis with stratified").at(32).rmse < 0.9 * independent.at(32).rmse);

    // The last point is what the table says.
    const std::string json = read_bytes(directory / "r.json");
    const std::size_t row = json.find("\"name\": \"path_mis with independent\"");
    const double variance = std::stod(json.substr(json.find("\"variance\": ", row) + 12));
    CHECK(independent.at(48).rmse == Approx(std::sqrt(variance)).epsilon(1e-6));
    CHECK_THAT(json, ContainsSubstring("\"curve\": ["));
    const std::string svg = read_bytes(directory / "out/convergence.svg");
    CHECK(svg.starts_with("<svg xmlns='http://www.w3.org/2000/svg'"));
    CHECK_THAT(svg, ContainsSubstring(">path_mis with sobol</text>"));
}

TEST_CASE("the map of a race says where an estimator is efficient", "[cli][race]")
{
    const RaceDirectory directory;
    const RunResult run =
        directory.race({"--integrators", "path_mis,path", "--spp", "16", "--rounds", "16", "--json", "-"});
    REQUIRE(run.exit_code == 0);
    const Image map = read_image(directory / "out/efficiency_path_mis.exr", false);
    const Image other = read_image(directory / "out/efficiency_path.exr", false);
    CHECK(map.channel_names() == Names{"Y"});
    CHECK(read_image(directory / "out/efficiency_path.png", false).full_width() == 96); // the scale is wider
    // 1 / efficiency is variance times seconds of the pixel: their sum over pixels is near mean variance x seconds, unless
    // variance and cost are strongly correlated.
    double cost = 0.0;
    int better = 0, noisy = 0;
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 24; ++x) {
            if (map.pixel(x, y)[0] == 0.f) continue; // light that the camera sees has no noise
            cost += 1.0 / static_cast<double>(map.pixel(x, y)[0]);
            better += map.pixel(x, y)[0] > other.pixel(x, y)[0] ? 1 : 0;
            ++noisy;
        }
    const auto number = [&](const std::string& key) {
        const std::size_t row = run.out.find("\"name\": \"path_mis\"");
        return std::stod(run.out.substr(run.out.find(key, row) + key.size()));
    };
    const double expected = number("\"variance\": ") * 16.0 * number("\"seconds_per_sample\": ");
    CHECK(cost > 0.3 * expected);
    CHECK(cost < 3.0 * expected);
    CHECK(noisy > 200);
    CHECK(better > 9 * noisy / 10);
}

TEST_CASE("against a reference, the error of a curve has the bias", "[cli][race]")
{
    const RaceDirectory directory;
    REQUIRE(directory
                .run({"easy.xml", "-o", "ref.exr", "--integrator", "path_mis", "--sampler", "sobol", "--spp",
                      "4096", "--seed", "99"})
                .exit_code == 0);
    const RunResult run = directory.race(
        {"--integrators", "path_mis,direct_mis", "--spp", "64", "--rounds", "12", "--reference", "ref.exr"});
    CHECK(run.exit_code == 3);
    const std::map<std::string, Curve> curves = curves_in(directory / "out/convergence.csv");
    const Curve& whole = curves.at("path_mis");
    const Curve& direct = curves.at("direct_mis");
    CHECK(whole.at(64).rmse == Approx(whole.at(16).rmse / 2.0).epsilon(0.1));
    CHECK(direct.at(64).rmse > 0.9 * direct.at(16).rmse);
    CHECK(direct.at(64).rmse > 2.0 * whole.at(64).rmse);

    const RunResult small = directory.race(
        {"--integrators", "path_mis,direct_mis", "--spp", "4", "--size", "12x9", "--reference", "ref.exr"});
    CHECK(small.exit_code == 1);
    CHECK_THAT(small.err,
               ContainsSubstring("the reference has 24x18 pixels at 0,0, and the scene 12x9 at 0,0"));
}

TEST_CASE("another program races with Plumb's estimators", "[cli][race][foreign]")
{
    const RaceDirectory directory;
    const RunResult run = directory.race(
        {"--integrators", "path_mis", "--spp", "32", "--rounds", "6", "--allow-commands", "--command",
         "other=" + plumb_command + "path_nee", "--command", plumb_command + "path_mis"});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, ContainsSubstring("  path_mis and other: agree, p "));
    CHECK_THAT(run.out, ContainsSubstring("  path_mis and renderer: agree, p "));
    const std::map<std::string, Curve> curves = curves_in(directory / "out/convergence.csv");
    REQUIRE(curves.size() == 3);
    CHECK(curves.at("other").size() == 6);
    CHECK(curves.at("renderer").at(32).rmse == Approx(curves.at("path_mis").at(32).rmse).epsilon(0.1));
    CHECK(std::filesystem::exists(directory / "out/efficiency_other.exr"));
    // Nothing else is left.
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory / "out")) ++files;
    CHECK(files == 8);
}

TEST_CASE("a race says in one sentence that there is no common scene", "[cli][race]")
{
    const RaceDirectory directory;
    const RunResult normals =
        directory.race({"--integrators", "path_mis,normals", "--spp", "4", "--rounds", "3"});
    CHECK(normals.exit_code == 3);
    CHECK_THAT(normals.out,
               ContainsSubstring("\ndiffer: path_mis and normals have no common scene, so their efficiencies "
                                 "are not comparable (normals: it shows normals, not light)\n"));
    const RunResult one =
        directory.race({"--integrators", "path_mis,path_nee,direct_mis", "--spp", "64", "--rounds", "8"});
    CHECK(one.exit_code == 3);
    CHECK_THAT(
        one.out,
        ContainsSubstring("\ndiffer: direct_mis has no common scene with the others, so the efficiencies are "
                          "not comparable (direct_mis: light of more than 1 surface bounce is omitted)\n"));
    const std::string small =
        std::string(PLUMB_RENDERER) +
        " {scene} -o {image} --seed {seed} --spp {spp} --size 12x9 --quiet --integrator path_mis";
    const RunResult size = directory.race({"--integrators", "path_mis", "--spp", "4", "--rounds", "3",
                                           "--allow-commands", "--command", "small=" + small});
    CHECK(size.exit_code == 1);
    CHECK_THAT(
        size.err,
        ContainsSubstring("error: 'small' renders 12x9 pixels and the others 24x18, so they have no common "
                          "scene\n"));
    const RunResult none = directory.race({"--integrators", "path_mis,av", "--spp", "4"});
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.err, ContainsSubstring("length must be given"));
    CHECK_THAT(none.err, ContainsSubstring("note: the estimator is 'av'\n"));
}

TEST_CASE("what is wrong with a command of a race", "[cli][race][foreign]")
{
    const RaceDirectory directory;
    const auto error = [&](const std::string& command, Names more = {"--allow-commands"}) {
        more.insert(more.begin(), {"--integrators", "path_mis", "--spp", "4", "--rounds", "3", "--quiet",
                                   "--command", command});
        return directory.race(more).err;
    };
    CHECK_THAT(
        error("x {image} {seed} {spp}", {}),
        ContainsSubstring(
            "error: --command runs another program, which needs --allow-commands: x {image} {seed} {spp}\n"));
    CHECK_THAT(error("x {image} {seed}"),
               ContainsSubstring("error: command 'x': the images of a race differ in seeds and "
                                 "numbers of samples; put {spp} into the command\n"));
    CHECK_THAT(error("x {seed} {spp}"),
               ContainsSubstring("the command does not say where to write; put {image} into it"));
    CHECK_THAT(error("x {image} {sed} {spp}"),
               ContainsSubstring("unknown placeholder '{sed}'; did you mean 'seed'?"));
    CHECK_THAT(
        error("no_such_program {image} {seed} {spp}"),
        ContainsSubstring(
            "error: 'no_such_program': cannot run 'no_such_program': there is no program of this name in "
            "PATH"));
    const RunResult fails =
        directory.race({"--integrators", "path_mis", "--spp", "4", "--rounds", "3", "--allow-commands",
                        "--command", "fails=sh -c 'echo dark; exit 3' {image} {seed} {spp}"});
    CHECK(fails.exit_code == 1);
    CHECK_THAT(fails.err, ContainsSubstring("error: 'fails': the command failed with exit code 3\n"
                                            "note: 'fails' printed: dark\n"));
    CHECK_THAT(error("slow=sleep 9 {image} {seed} {spp}", {"--allow-commands", "--timeout", "0.2s"}),
               ContainsSubstring("'slow': "));
    CHECK_THAT(
        directory.run({"race", "easy.xml", "--command", "x {image} {seed} {spp}", "--allow-commands"}).err,
        ContainsSubstring("error: --command needs --out DIR, where the program works\n"));
    CHECK_THAT(
        error("x {image} {seed} {spp}", {"--allow-commands", "--command", "x -v {image} {seed} {spp}"}),
        ContainsSubstring("error: two commands are called 'x'; name them: --command 'NAME=x ...'\n"));
}
