// SPDX-License-Identifier: MIT

// renderer denoise, --denoise, and what compare, batch and rerun make of denoised images: with a library that only shows what it
// was told (tests/denoiser/fake_oidn.cpp), and with the real one where that is installed.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "plumb/base/error.h"
#include "plumb/denoise/denoise.h"
#include "support/catch.h"

using namespace plumb;

namespace {

const Names with_fake = {"PLUMB_OIDN=" PLUMB_FAKE_OIDN};

struct DenoiseDirectory : SceneDirectory {
    RunResult fake(const Names& words) const { return run_renderer(words, path(), "", {}, with_fake); }
    Names channels(const char* file) const { return read_image(*this / file, false).channel_names(); }
};

void check_scaled(const Image& image, const Image& of, float factor)
{
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x) REQUIRE(image.color(x, y) == of.color(x, y) * factor);
}

} // namespace

TEST_CASE("denoise guides the filter by the layers that there are", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    struct Case {
        const char* aov;
        float factor;
        const char* how;
    };
    const Case one =
        GENERATE(Case{"depth", 0.5f, ""}, Case{"albedo", 0.25f, " with albedo"},
                 Case{"normal,albedo", 0.125f, " with albedo and normal"},
                 Case{"albedo,albedo_behind,normal_behind", 0.125f, " with albedo_behind and normal_behind"});
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--aov", one.aov}).exit_code == 0);
    const RunResult run = directory.fake({"denoise", "a.exr", "-o", "d.exr", "-o", "d.png"});
    CHECK(run.exit_code == 0);
    CHECK(run.err == std::string("d.exr and d.png: denoised by Open Image Denoise 2.99.7") + one.how + "\n");
    const Image before = read_image(directory / "a.exr", false);
    const Image after = read_image(directory / "d.exr", false);
    check_scaled(after, before, one.factor);
    // Layers stay, and error bars, which are of another image, do not.
    for (const std::string& name : before.channel_names()) {
        const auto& names = after.channel_names();
        const bool is_there = std::find(names.begin(), names.end(), name) != names.end();
        CHECK(is_there != (name.starts_with("variance.") || name == "contributing"));
    }
}

TEST_CASE("headers say that an image was denoised", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "-o", "a.jpg", "--tonemap", "aces"}).exit_code == 0);
    REQUIRE(directory.fake({"denoise", "a.exr", "-o", "d.exr", "-o", "d.png", "-o", "d.jpg"}).exit_code == 0);
    const ImageHeader before = header(directory / "a.exr"), after = header(directory / "d.exr");
    CHECK(integer(before, "plumb:biased") == 0);
    CHECK(before.contains("plumb:rmse"));
    CHECK(integer(after, "plumb:biased") == 1);
    CHECK(text(after, "plumb:biases") == "it was denoised");
    CHECK(text(after, "plumb:denoised") == "Open Image Denoise 2.99.7");
    CHECK_FALSE(after.contains("plumb:rmse"));
    CHECK_FALSE(after.contains("plumb:rmseInterval"));
    CHECK(text(after, "plumb:inputHash") == text(before, "plumb:inputHash"));
    CHECK(text(header(directory / "d.png"), "plumb:display") ==
          "denoised, tonemap aces"); // the header's curve
    CHECK(text(header(directory / "d.png"), "plumb:denoised") == "Open Image Denoise 2.99.7");
    CHECK(text(header(directory / "d.jpg"), "ImageDescription") == "plumb:display denoised, tonemap aces");

    // Other biases stay.
    REQUIRE(directory.run({"scene.xml", "-o", "b.exr", "--time", "0.1", "--spp", "64000"}).exit_code == 0);
    REQUIRE(directory.fake({"denoise", "b.exr", "-o", "e.exr"}).exit_code == 0);
    CHECK(text(header(directory / "e.exr"), "plumb:biases") ==
          text(header(directory / "b.exr"), "plumb:biases") + ", it was denoised");
}

TEST_CASE("a denoised image is no reference", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "-o", "a.png"}).exit_code == 0);
    REQUIRE(directory.fake({"denoise", "a.exr", "-o", "d.exr", "-o", "d.png", "-o", "d.jpg"}).exit_code == 0);
    const std::string refusal =
        "error: B was denoised (Open Image Denoise 2.99.7), and a reference must not be: its "
        "error is unknown; compare with the image that was denoised\n";
    for (const Names& words :
         {Names{"compare", "a.exr", "d.exr"}, Names{"compare", "a.exr", "d.exr", "--exact", "B"},
          Names{"compare", "a.png", "d.png", "--max", "rmse=9"},
          Names{"compare", "d.exr", "d.exr", "--no-verdict", "--max", "rmse=9"}}) {
        const RunResult run = directory.run(words);
        CHECK(run.exit_code == 1);
        CHECK(run.err == refusal);
    }
    CHECK_THAT(directory.run({"compare", "a.png", "d.jpg"}).err,
               ContainsSubstring("error: B was denoised (denoised)"));
    // As the image under test it may be compared, by limits: how good is the denoiser?
    CHECK(directory.run({"compare", "d.exr", "a.exr", "--no-verdict", "--max", "rmse=9"}).exit_code == 0);

    directory.write("suite.xml", R"(<suite><render scene="scene.xml" spp="4" reference="d.exr"/></suite>)");
    const RunResult suite = directory.run({"batch", "suite.xml"});
    CHECK(suite.exit_code == 1);
    CHECK_THAT(suite.out + suite.err, ContainsSubstring("B was denoised (Open Image Denoise 2.99.7)"));

    CHECK(directory.run({"rerun", "d.exr", "-o", "r.exr"}).err ==
          "error: 'd.exr' was denoised (Open Image Denoise 2.99.7); render the image again that it was made "
          "from\n");
    CHECK(directory.fake({"denoise", "d.exr", "-o", "e.exr"}).err ==
          "error: the image is denoised already: Open Image Denoise 2.99.7\n");
}

TEST_CASE("a checkpoint is viewed as the image so far, and not denoised", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    REQUIRE(directory
                .run({"scene.xml", "--spp", "8", "--part", "1/2", "--part-by", "samples", "--aov", "albedo",
                      "-o", "part.exr"})
                .exit_code == 0);
    const RunResult refused = directory.fake({"denoise", "part.exr", "-o", "d.png"});
    CHECK(refused.exit_code == 1);
    CHECK(refused.err == "error: cannot denoise a checkpoint or a partial render, whose layers are sums; "
                         "'renderer merge FILE -o "
                         "IMAGE.exr', with --allow-missing if it is not over, makes an image of it\n");
    CHECK(!std::filesystem::exists(directory / "d.png"));

    REQUIRE(directory.run({"merge", "part.exr", "--allow-missing", "-o", "m.exr", "-o", "m.png"}).exit_code ==
            0);
    REQUIRE(directory.run({"view", "part.exr", "-o", "v.png"}).exit_code == 0);
    const Image merged = read_image(directory / "m.png", false);
    const Image viewed = read_image(directory / "v.png", false);
    check_scaled(viewed, merged, 1.f);
    CHECK(directory.fake({"denoise", "m.exr", "-o", "d.png"}).exit_code == 0);
}

TEST_CASE("--denoise is for files for screens, with guides", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    REQUIRE(
        directory.run({"scene.xml", "-o", "plain.exr", "--aov", "albedo_behind,normal_behind"}).exit_code ==
        0);
    const RunResult run = directory.fake({"scene.xml", "-o", "a.exr", "-o", "a.png", "--denoise"});
    CHECK(run.exit_code == 0);
    const Image plain = read_image(directory / "plain.exr", false),
                image = read_image(directory / "a.exr", false);
    check_scaled(image, plain, 1.f);
    CHECK(image.channel_names() == plain.channel_names());
    const ImageHeader exr = header(directory / "a.exr");
    CHECK(integer(exr, "plumb:biased") == 0);
    CHECK(text(exr, "plumb:denoised") == "no plumb:denoised");
    CHECK(text(exr, "plumb:set.denoise") == "true");
    CHECK(text(exr, "plumb:set.aov") == "albedo_behind,normal_behind");
    CHECK(text(header(directory / "a.png"), "plumb:denoised") ==
          "Open Image Denoise 2.99.7 with albedo_behind and normal_behind");
    const Image shown = read_image(directory / "a.png", true);
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 48; ++x)
            REQUIRE(srgb_from_linear(shown.color(x, y).g) ==
                    Approx(srgb_from_linear(std::min(1.f, image.color(x, y).g * 0.125f)))
                        .margin(0.5 / 255.0 + 1e-5));

    // Settings are for rerun and merge, too; an .exr alone needs no denoiser.
    REQUIRE(directory.fake({"rerun", "a.exr", "-o", "b.exr", "-o", "b.png"}).exit_code == 0);
    CHECK(read_bytes(directory / "b.exr") == read_bytes(directory / "a.exr"));
    CHECK(read_bytes(directory / "b.png") == read_bytes(directory / "a.png"));
    CHECK(directory.run({"scene.xml", "-o", "p.exr", "--denoise", "--part", "1/1"}).exit_code == 0);
    REQUIRE(directory.fake({"merge", "p.exr", "-o", "m.png"}).exit_code == 0);
    CHECK(read_byte_image(directory / "m.png")->values == read_byte_image(directory / "a.png")->values);

    CHECK(directory.fake({"scene.xml", "-o", "x.exr", "--denoise"}).err ==
          "error: --denoise changes .png and .jpg files, and none is written; add -o FILE.png, or use "
          "'renderer "
          "denoise' later\n");
    directory.write("suite.xml",
                    R"(<suite><render scene="scene.xml" denoise="true" reference="r.png"/></suite>)");
    const RunResult suite = directory.fake({"batch", "suite.xml", "--update"});
    CHECK(suite.exit_code == 1);
    CHECK_THAT(suite.out + suite.err, ContainsSubstring("'r.png' cannot be made with 'denoise'"));
}

TEST_CASE("a denoiser that is not there is missed before anything is rendered", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr"}).exit_code == 0);
    const auto run = [&](const Names& words, const Names& variables) {
        return run_renderer(words, directory.path(), "", {}, variables);
    };
    const Names nowhere = {"PLUMB_OIDN=nowhere.so"};
    const RunResult named = run({"denoise", "a.exr", "-o", "d.exr"}, nowhere);
    CHECK(named.exit_code == 1);
    CHECK_THAT(named.err, ContainsSubstring("error: cannot denoise: 'nowhere.so' cannot be loaded: "));
    const RunResult rendering = run({"scene.xml", "-o", "d.png", "--denoise", "--spp", "1000000"}, nowhere);
    CHECK(rendering.exit_code == 1);
    CHECK_THAT(rendering.err, ContainsSubstring("error: cannot denoise: "));
    CHECK_FALSE(std::filesystem::exists(directory / "d.png"));
    // Some library, but not this one.
    directory.write("other.so", "");
    std::filesystem::remove(directory / "other.so");
    std::filesystem::copy_file(PLUMB_KILLER, directory / "other.so");
    const RunResult other = run({"denoise", "a.exr", "-o", "d.exr"}, {"PLUMB_OIDN=./other.so"});
    CHECK(other.exit_code == 1);
    CHECK_THAT(other.err, ContainsSubstring("lacks oidnNewDevice: it is no Open Image Denoise 2"));

    const RunResult missing = run({"denoise", "a.exr", "-o", "d.exr"},
                                  {"PLUMB_OIDN=", "HOME=" + directory.path().string(), "XDG_DATA_HOME="});
    if (missing.exit_code == 0) return; // the system has one
    CHECK_THAT(missing.err,
               ContainsSubstring("error: cannot denoise: Open Image Denoise 2 is not installed ("));
    CHECK_THAT(
        missing.err,
        ContainsSubstring(
            "); tools/install-denoiser (renderer-install-denoiser, where Plumb is installed) installs it for "
            "this user, or PLUMB_OIDN names the file\n"));
}

TEST_CASE("what a denoiser complains about is an error", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    Image image(4, 4);
    image.pixel(1, 1)[0] = 666.f;
    write_image(directory / "a.exr", image);
    const RunResult run = directory.fake({"denoise", "a.exr", "-o", "d.exr"});
    CHECK(run.exit_code == 1);
    CHECK(run.err == "error: cannot denoise: the devil is in it\n");
    write_image(directory / "y.exr", Image({0, 0, 2, 2}, 2, 2, {"Y"}));
    CHECK(directory.fake({"denoise", "y.exr", "-o", "d.exr"}).err ==
          "error: cannot denoise an image without the channels R, G and B\n");
}

TEST_CASE("wrong usage of denoise", "[cli][denoise]")
{
    const DenoiseDirectory directory;
    const auto complaint = [&](Names words) {
        words.insert(words.begin(), {"denoise", "a.exr"});
        const RunResult run = directory.run(words);
        CHECK(run.exit_code == 2);
        return run.err;
    };
    CHECK(complaint({}) == "error: denoise needs -o,--output FILE\n");
    CHECK(complaint({"-o", "d.hdr"}) ==
          "error: 'd.hdr' must end in .exr, .png or .jpg: other files cannot say that they were denoised\n");
    CHECK(complaint({"-o", "d.exr", "--tonemap", "aces"}) ==
          "error: --exposure and --tonemap change .png and .jpg files, and none is written\n");
}

TEST_CASE("the real denoiser lowers the error, with guides and without", "[cli][denoise]")
{
    try {
        check_denoiser();
    } catch (const Error&) {
        WARN("Open Image Denoise is not installed");
        return;
    }
    const DenoiseDirectory directory;
    const auto render = [&](Names words) {
        words.insert(words.begin(), "scene.xml");
        REQUIRE(directory.run(words).exit_code == 0);
        return read_image(directory / words[2], false);
    };
    // Naive path tracing stays noisy, whatever is done for the other integrators.
    const Image truth = render({"-o", "t.exr", "--spp", "4096", "--seed", "1"});
    const Image noisy = render({"-o", "a.exr", "--spp", "16", "--integrator", "path"});
    const Image guided = denoised(render(
        {"-o", "g.exr", "--spp", "16", "--integrator", "path", "--aov", "albedo_behind,normal_behind"}));
    const auto error = [&](const Image& image) {
        double sum = 0.0;
        for (int y = 0; y < 36; ++y)
            for (int x = 0; x < 48; ++x)
                for (int c = 0; c < 3; ++c)
                    sum += std::pow(double(image.color(x, y)[c]) - double(truth.color(x, y)[c]), 2.0);
        return std::sqrt(sum / (36 * 48 * 3));
    };
    CAPTURE(error(noisy), error(denoised(noisy)), error(guided));
    CHECK(error(denoised(noisy)) < 0.5 * error(noisy));
    CHECK(error(guided) < 0.5 * error(noisy));
    CHECK(denoised_text(guided.metadata).starts_with("Open Image Denoise 2."));
}
