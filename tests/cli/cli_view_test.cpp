// SPDX-License-Identifier: MIT

// --exposure, --tonemap and the verb view, with the real program; and what compare and batch make of such files.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "plumb/image/development.h"
#include "support/catch.h"

using namespace plumb;

namespace {

void check_same_values(const std::filesystem::path& a, const std::filesystem::path& b)
{
    const auto first = read_byte_image(a), second = read_byte_image(b);
    REQUIRE((first && second));
    CHECK(first->values == second->values);
}

} // namespace

TEST_CASE("a tone curve changes the files for screens alone, and the headers say so", "[cli][view]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "plain.exr", "-o", "plain.png"}).exit_code == 0);
    const std::string curve = GENERATE("filmic", "aces", "agx");
    REQUIRE(
        directory.run({"scene.xml", "-o", "a.exr", "-o", "a.png", "--tonemap", curve, "--exposure", "-0.5"})
            .exit_code == 0);
    const Image plain = read_image(directory / "plain.exr", false);
    const Image image = read_image(directory / "a.exr", false);
    const Image shown = read_image(directory / "a.png", false);
    const ToneCurve tone = curve == "filmic" ? ToneCurve::filmic
                           : curve == "aces" ? ToneCurve::aces
                                             : ToneCurve::agx;
    const Developer develop({-0.5f, tone});
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) {
            REQUIRE(image.color(x, y) == plain.color(x, y));
            for (int c = 0; c < 3; ++c)
                REQUIRE(shown.pixel(x, y)[c] ==
                        Approx(develop(image.color(x, y))[c]).margin(0.5 / 255.0 + 1e-6));
        }
    CHECK(text(header(directory / "a.exr"), "plumb:set.tonemap") == curve);
    CHECK(text(header(directory / "a.exr"), "plumb:display") == "no plumb:display");
    CHECK(text(header(directory / "a.png"), "plumb:display") == "exposure -0.5, tonemap " + curve);
    CHECK(text(header(directory / "plain.png"), "plumb:display") == "no plumb:display");

    // From the header alone.
    REQUIRE(directory.run({"rerun", "a.exr", "-o", "b.exr", "-o", "b.png"}).exit_code == 0);
    CHECK(read_bytes(directory / "b.exr") == read_bytes(directory / "a.exr"));
    CHECK(read_bytes(directory / "b.png") == read_bytes(directory / "a.png"));
    // Without rendering.
    const RunResult view = directory.run({"view", "a.exr", "-o", "v.png"});
    CHECK(view.exit_code == 0);
    CHECK(view.out == "R, G, B: exposure -0.5, tonemap " + curve + "\n");
    check_same_values(directory / "v.png", directory / "a.png");
    REQUIRE(
        directory.run({"view", "a.exr", "-o", "n.png", "--tonemap", "none", "--exposure", "0"}).exit_code ==
        0);
    check_same_values(directory / "n.png", directory / "plain.png");
    REQUIRE(
        directory
            .run({"view", "plain.exr", "-o", "w.png", "--tonemap", curve, "--exposure", "-0.5", "--quiet"})
            .exit_code == 0);
    check_same_values(directory / "w.png", directory / "a.png");
}

TEST_CASE("a tone curve of parts is that of the merged image", "[cli][view]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.png", "--tonemap", "agx"}).exit_code == 0);
    for (const std::string part : {"1", "2"})
        REQUIRE(
            directory.run({"scene.xml", "-o", "p" + part + ".exr", "--tonemap", "agx", "--part", part + "/2"})
                .exit_code == 0);
    REQUIRE(directory.run({"merge", "p1.exr", "p2.exr", "-o", "m.png"}).exit_code == 0);
    check_same_values(directory / "m.png", directory / "a.png");
}

TEST_CASE("a tone curve without a file that it applies to is wrong usage", "[cli][view]")
{
    const SceneDirectory directory;
    const Names option = GENERATE(Names{"--tonemap", "aces"}, Names{"--exposure", "1"});
    const RunResult result = directory.run({"scene.xml", "-o", "a.exr", option[0], option[1]});
    CHECK(result.exit_code == 2);
    CHECK(result.err ==
          "error: --exposure and --tonemap change .png and .jpg files, and none is written; add "
          "-o FILE.png, or develop the image later with 'renderer view'\n");
    const RunResult unknown = directory.run({"scene.xml", "--tonemap", "reinhard"});
    CHECK(unknown.exit_code == 2);
    CHECK_THAT(unknown.err,
               ContainsSubstring("--tonemap cannot be 'reinhard'; known are none, filmic, aces and agx"));
}

TEST_CASE("view shows layers, with a legend", "[cli][view]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--aov", "normal,depth,object,albedo"}).exit_code ==
            0);
    const auto legend = [&](const Names& more) {
        Names words = {"view", "a.exr", "-o", "v.png"};
        words.insert(words.end(), more.begin(), more.end());
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        CHECK(read_image(directory / "v.png", false).channel_count() == 3);
        return result.out;
    };
    CHECK(legend({"--layer", "normal"}) ==
          "normal.X: -1 to 1 as red\nnormal.Y: -1 to 1 as green\nnormal.Z: -1 to 1 as blue\n");
    CHECK(legend({"--layer", "depth"}).starts_with("depth.Z: 0 (black) to "));
    CHECK(legend({"--layer", "depth", "--false-color", "--range", "4,6"}) ==
          "depth.Z: 4 (dark purple) to 6 (light yellow)\n");
    CHECK(text(header(directory / "v.png"), "plumb:display") ==
          "depth.Z: 4 (dark purple) to 6 (light yellow)");
    CHECK(legend({"--layer", "albedo", "--exposure", "1"}) == "albedo.R, albedo.G, albedo.B: exposure 1\n");
    CHECK(legend({"--layer", "variance", "--false-color", "--log"}).starts_with("luminance of variance.R, "));
    CHECK_THAT(legend({"--layer", "object"}), ContainsSubstring("pixels shape 'rectangle' (scene.xml:10)\n"));
    CHECK(legend({"--layer", "contributing"}).starts_with("contributing: 0 (black) to 4 (white)"));
}

TEST_CASE("wrong usage of view", "[cli][view]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "-o", "a.png"}).exit_code == 0);
    const auto complaint = [&](Names words, int code) {
        words.insert(words.begin(), "view");
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == code);
        return result.err;
    };
    CHECK(complaint({"a.exr"}, 2) == "error: view needs -o,--output FILE.png\n");
    CHECK(complaint({"a.exr", "-o", "b.exr"}, 2) ==
          "error: 'b.exr' must end in .png or .jpg: view makes images for screens\n");
    CHECK(complaint({"a.exr", "-o", "b.png", "--false-color", "--tonemap", "aces"}, 2) ==
          "error: --false-color has no use for --exposure and --tonemap; choose the colours' range with "
          "--range\n");
    CHECK(complaint({"a.exr", "-o", "b.png", "--range", "2,1"}, 2) ==
          "error: --range must begin below its end, not '2,1'\n");
    CHECK(complaint({"a.exr", "-o", "b.png", "--range", "2"}, 2) ==
          "error: --range must be LOW,HIGH, not '2'\n");
    CHECK_THAT(
        complaint({"a.exr", "-o", "b.png", "--layer", "depth"}, 1),
        ContainsSubstring("error: the image has no layer or channel 'depth'; its layers are variance"));
    CHECK(complaint({"a.png", "-o", "a.png"}, 1) == "error: cannot write 'a.png': it is the image to read\n");
    CHECK_THAT(complaint({"none.exr", "-o", "b.png"}, 1), ContainsSubstring("cannot read 'none.exr'"));
}

TEST_CASE("compare refuses images that were developed differently", "[cli][view][compare]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "-o", "a.png"}).exit_code == 0);
    for (const std::string extension : {".png", ".jpg"}) {
        REQUIRE(
            directory.run({"scene.xml", "-o", "t" + extension, "--tonemap", "aces", "--quiet"}).exit_code ==
            0);
        REQUIRE(
            directory.run({"scene.xml", "-o", "u" + extension, "--tonemap", "aces", "--seed", "1", "--quiet"})
                .exit_code == 0);
        const std::string refusal = "error: the images were developed differently: A without a curve or "
                                    "exposure, B as 'tonemap aces'; "
                                    "compare images of light, such as .exr files\n";
        for (const char* a : {"a.exr", "a.png"}) {
            const RunResult result = directory.run({"compare", a, "t" + extension});
            CHECK(result.exit_code == 1);
            CHECK(result.err == refusal);
            // Nor as an exact one, nor for limits alone.
            CHECK(directory.run({"compare", a, "t" + extension, "--exact", "B"}).err == refusal);
            CHECK(directory.run({"compare", a, "t" + extension, "--no-verdict", "--max", "rmse=9"}).err ==
                  refusal);
        }
        // Two of the same kind may be compared by limits; there is no verdict.
        const RunResult both =
            directory.run({"compare", "u" + extension, "t" + extension, "--max", "rmse=9"});
        CHECK(both.exit_code == 0);
        CHECK_THAT(both.out, ContainsSubstring("both images were developed for screens (tonemap aces)"));
        CHECK(directory.run({"compare", "u" + extension, "t" + extension}).exit_code == 4);
    }
}

TEST_CASE("batch neither takes nor makes developed references", "[cli][view][batch]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "t.png", "--tonemap", "aces"}).exit_code == 0);
    const RunResult fresh = [&] {
        directory.write("suite.xml",
                        R"(<suite><render scene="scene.xml" spp="2" reference="t.png"/></suite>)");
        return directory.run({"batch", "suite.xml"});
    }();
    CHECK(fresh.exit_code == 1);
    CHECK_THAT(fresh.err + fresh.out, ContainsSubstring("the images were developed differently: A without a "
                                                        "curve or exposure, B as 'tonemap aces'"));

    directory.write(
        "suite.xml",
        R"(<suite><render scene="scene.xml" spp="2" tonemap="agx" reference="made.png"/></suite>)");
    const RunResult made = directory.run({"batch", "suite.xml", "--update"});
    CHECK(made.exit_code == 1);
    CHECK_THAT(made.err + made.out,
               ContainsSubstring("'made.png' cannot be made with 'tonemap agx': a reference "
                                 "has the values of light; make an .exr file"));
    CHECK_FALSE(std::filesystem::exists(directory / "made.png"));

    // An .exr reference holds light whatever curve the .png beside it has.
    directory.write(
        "suite.xml",
        R"(<suite><render scene="scene.xml" spp="16" tonemap="agx" reference="made.exr"/></suite>)");
    CHECK(directory.run({"batch", "suite.xml", "--update"}).exit_code == 0);
    CHECK(text(header(directory / "made.png"), "plumb:display") == "tonemap agx");
    CHECK(directory.run({"batch", "suite.xml"}).exit_code == 0);
}
