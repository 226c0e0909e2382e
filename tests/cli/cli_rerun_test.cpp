// SPDX-License-Identifier: MIT

// Error bars, the ledger of biases, and images rendered again from their headers.

#include "base/shell_words.h"
#include "base/text.h"
#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"

#include <cmath>
#include <fmt/format.h>

using namespace plumb;

namespace {

const std::string triangle = "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n";

std::string scene_with_mesh()
{
    std::string scene = small_scene();
    scene.insert(scene.find("</scene>"),
                 R"(<mesh type="obj"><string name="filename" value="triangle.obj"/></mesh>)");
    return scene;
}

} // namespace

TEST_CASE("words for a shell come back as they were", "[unit][text]")
{
    const Names words = {"plain", "", "two words", "it's", "a=b", "'", "\\", "\n", "--define", "x='y z'"};
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_quote(word);
    CHECK(shell_split(line) == words);
    CHECK(shell_split("").empty());
}

TEST_CASE("an image says how sure it is", "[cli][evidence]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--spp", "16"}).exit_code == 0);
    const auto found = header(directory / "a.exr");
    CHECK(integer(found, "plumb:biased") == 0);
    CHECK(found.count("plumb:biases") == 0);
    const float rmse = std::get<float>(found.at("plumb:rmse"));
    const auto& interval = std::get<std::vector<float>>(found.at("plumb:rmseInterval"));
    REQUIRE(interval.size() == 2);
    CHECK(interval[0] < rmse);
    CHECK(rmse < interval[1]);

    // The error against an image with a hundred times the samples is what was foretold, to a third.
    REQUIRE(directory.run({"scene.xml", "-o", "b.exr", "--spp", "1600", "--seed", "9"}).exit_code == 0);
    const Image a = read_image(directory / "a.exr", false);
    const Image b = read_image(directory / "b.exr", false);
    double sum = 0.0;
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x)
            for (int c = 0; c < 3; ++c)
                sum += std::pow(double(a.color(x, y)[c]) - double(b.color(x, y)[c]), 2.0);
    CHECK(std::sqrt(sum / (36 * 48 * 3)) == Approx(rmse).epsilon(0.33));

    REQUIRE(directory.run({"scene.xml", "-o", "c.exr", "--spp", "16", "--no-variance"}).exit_code == 0);
    CHECK(read_image(directory / "c.exr", false).channel_names() == Names{"R", "G", "B"});
    REQUIRE(directory.run({"scene.xml", "-o", "d.exr", "--spp", "1"}).exit_code == 0);
    CHECK(header(directory / "d.exr").count("plumb:rmse") == 0);
    const Image d = read_image(directory / "d.exr", false);
    CHECK(d.channel_names()[4] == "variance.R");
    CHECK(std::isnan(d.pixel(3, 3)[4]));
}

TEST_CASE("what makes an image biased is in its header and in the log", "[cli][evidence]")
{
    const SceneDirectory directory;
    directory.write(
        "cut.xml",
        small_scene(R"(<integrator type="path_mis"><integer name="maxDepth" value="2"/></integrator>)"));
    const RunResult run = directory.run({"cut.xml", "-o", "a.exr", "--emitters", "absorb"});
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.err, ContainsSubstring("biased: light of more than 2 surface bounces is omitted\n"));
    const auto found = header(directory / "a.exr");
    CHECK(integer(found, "plumb:biased") == 1);
    CHECK(text(found, "plumb:biases") == "light of more than 2 surface bounces is omitted");
    CHECK(text(found, "plumb:model") == "emitters absorb incident light");
}

TEST_CASE("an image is rendered again from its header, to the same bytes", "[cli][rerun]")
{
    const SceneDirectory directory;
    directory.write("sub/it's.xml", small_scene());
    const Names words =
        GENERATE(Names{}, Names{"--spp", "3", "--seed", "18446744073709551615"}, Names{"--crop", "5,6,20,11"},
                 Names{"--integrator", "path_nee", "--size", "20x30", "--isa", "sse4.2"},
                 Names{"--no-variance", "--mirror", "on", "--emitters", "absorb", "--dialect", "eth"});
    Names first = {"sub/it's.xml", "-o", "a.exr"};
    first.insert(first.end(), words.begin(), words.end());
    const RunResult rendered = directory.run(first);
    INFO(rendered.err);
    REQUIRE(rendered.exit_code == 0);
    const RunResult again = directory.run({"rerun", "a.exr", "-o", "b.exr", "--threads", "3"});
    INFO(again.err);
    REQUIRE(again.exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "b.exr"));
    // And the new one is as good.
    REQUIRE(directory.run({"rerun", "b.exr", "-o", "c.exr", "--quiet"}).exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "c.exr"));
}

TEST_CASE("rerun names what has changed", "[cli][rerun]")
{
    const SceneDirectory directory;
    directory.write("scene.xml", scene_with_mesh());
    directory.write("triangle.obj", triangle);
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr"}).exit_code == 0);
    const auto complaint = [&](const Names& more = {}) {
        Names words = {"rerun", "a.exr", "-o", "b.exr", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        const RunResult run = directory.run(words);
        CHECK(run.exit_code == 1);
        CHECK_FALSE(std::filesystem::exists(directory / "b.exr"));
        return run.err;
    };
    directory.write("triangle.obj", triangle + "\n");
    CHECK(complaint() == "error: the scene has changed: 'triangle.obj' has changed\n");
    directory.write("triangle.obj", triangle);
    directory.write("scene.xml", scene_with_mesh() + "\n");
    CHECK(complaint() == "error: the scene has changed: 'scene.xml' has changed\n");
    directory.write("scene.xml", small_scene());
    CHECK(complaint() ==
          "error: the scene has changed: 'scene.xml' has changed and 'triangle.obj' is no longer an input\n");
    directory.write("moved/scene.xml", scene_with_mesh());
    directory.write("moved/triangle.obj", triangle);
    std::filesystem::remove(directory / "scene.xml");
    CHECK(complaint() == "error: scene file 'scene.xml' exists neither here nor beside 'a.exr'; pass its "
                         "path with --scene\n");
    REQUIRE(directory.run({"rerun", "a.exr", "-o", "b.exr", "--scene", "moved/scene.xml"}).exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "b.exr"));
}

TEST_CASE("rerun takes images of ours, and keeps them", "[cli][rerun]")
{
    const SceneDirectory directory;
    write_image(directory / "foreign.exr", Image(2, 2));
    const RunResult foreign = directory.run({"rerun", "foreign.exr", "-o", "b.exr"});
    CHECK(foreign.exit_code == 1);
    CHECK(foreign.err == "error: the header of 'foreign.exr' does not say how the image was made; those of "
                         ".exr files rendered by Plumb do\n");
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr"}).exit_code == 0);
    const std::string bytes = read_bytes(directory / "a.exr");
    const RunResult same = directory.run({"rerun", "a.exr", "-o", "a.exr"});
    CHECK(same.exit_code == 1);
    CHECK(same.err == "error: cannot write 'a.exr': it is the image to render again\n");
    CHECK(read_bytes(directory / "a.exr") == bytes);
    CHECK(directory.run({"rerun", "a.exr"}).exit_code == 2);
    CHECK(directory.run({"rerun", "none.exr", "-o", "b.exr"}).exit_code == 1);
}

TEST_CASE("an image that was made when the scene language meant something else is not made again",
          "[cli][rerun]")
{
    const SceneDirectory directory;
    const auto image_of = [&](const std::string& more, const Names& options = {}) {
        std::string scene = small_scene();
        directory.write("scene.xml", scene.insert(scene.find("</scene>"), more));
        Names words = {"scene.xml", "-o", "new.exr", "--spp", "1", "--quiet"};
        words.insert(words.end(), options.begin(), options.end());
        REQUIRE(directory.run(words).exit_code == 0);
        // Plumb 0.1 wrote no version of the language.
        Image image = read_image(directory / "new.exr", false);
        CHECK(integer(header(directory / "new.exr"), "plumb:language") == language_version);
        std::erase_if(image.metadata, [](const auto& entry) { return entry.first == "plumb:language"; });
        write_image(directory / "old.exr", image);
        CHECK(directory.run({"rerun", "new.exr", "-o", "again.exr", "--quiet"}).exit_code == 0);
        return directory.run({"rerun", "old.exr", "-o", "again.exr", "--quiet"});
    };
    const std::string sun =
        R"(<emitter type="directional"><vector name="direction" value="0,-1,0"/></emitter>)";
    const RunResult refused = image_of(sun);
    CHECK(refused.exit_code == 1);
    CHECK(refused.err == "error: cannot render 'old.exr' again: it was made with version 1 of the scene "
                         "language, in which the direction of a directional light had a different meaning "
                         "than in version 2; render the scene itself\n");
    const auto checks = [](const char* delta) {
        return fmt::format(
            R"(<shape type="sphere"><bsdf type="diffuse"><texture type="checkerboard_color" name="albedo">)"
            R"(<point name="delta" value="{}"/></texture></bsdf></shape>)",
            delta);
    };
    CHECK_THAT(image_of(checks("0.5,0")).err, ContainsSubstring("the delta of a checkerboard"));
    // What means the same can be made again.
    CHECK(image_of(checks("0,0")).exit_code == 0);
    CHECK(image_of(sun, {"--dialect", "mcgill"}).exit_code == 0);
    CHECK(image_of("").exit_code == 0);
}
