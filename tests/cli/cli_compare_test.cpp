// SPDX-License-Identifier: MIT

// `renderer compare`: what it prints and how it ends.

#include "plumb/image.h"
#include "support/catch.h"
#include "support/noisy_picture.h"
#include "support/run.h"

using namespace plumb;
using namespace plumb::test;

namespace {

struct PictureFolder : TempFolder {
    PictureFolder()
    {
        NoisyPicture how;
        how.size = 32;
        how.channels = {"R", "G", "B"};
        write_image(path() / "a.exr", noisy_picture(how, exponential_samples(), 1));
        write_image(path() / "b.exr", noisy_picture(how, exponential_samples(), 2));
        write_image(path() / "few.exr", noisy_picture(how, hits(1e-4), 3));
        how.bias = 1.2;
        write_image(path() / "bright.exr", noisy_picture(how, exponential_samples(), 4));
        how.size = 16;
        write_image(path() / "small.exr", noisy_picture(how, exponential_samples(), 5));
        how.size = 32;
        how.bias = 1.0;
        write_image(path() / "truth.exr", true_picture(how));
        write_image(path() / "truth.png", true_picture(how));
    }
    RunResult compare(std::vector<std::string> words) const
    {
        words.insert(words.begin(), "compare");
        return run_renderer(words, path());
    }
};

} // namespace

TEST_CASE("the exit code of compare is its verdict", "[cli][compare]")
{
    const PictureFolder folder;
    const RunResult same = folder.compare({"a.exr", "b.exr"});
    INFO(same.out << same.err);
    CHECK(same.exit_code == 0);
    CHECK(same.err.empty());
    CHECK(same.out.starts_with("A a.exr\nB b.exr\n  mse "));
    CHECK(same.out.ends_with("\npasses\n"));
    CHECK_THAT(same.out, ContainsSubstring("no difference beyond the noise at significance 0.01\n"));
    CHECK_THAT(same.out, ContainsSubstring("would have been found with 90 % probability\n"));

    const RunResult bright = folder.compare({"bright.exr", "b.exr"});
    CHECK(bright.exit_code == 3);
    CHECK(bright.out.ends_with("\ndiffers\n"));
    CHECK_THAT(bright.out, ContainsSubstring("a difference beyond the noise"));

    const RunResult few = folder.compare({"few.exr", "b.exr"});
    CHECK(few.exit_code == 4);
    CHECK(few.out.ends_with("\nundecided\n"));
    CHECK_THAT(few.out,
               ContainsSubstring("1024 of 1024 pixels lie in no square where the samples support a test"));

    const RunResult sizes = folder.compare({"small.exr", "b.exr"});
    CHECK(sizes.exit_code == 1);
    CHECK(sizes.err == "error: the images have different sizes: A is 16x16 pixels, B is 32x32 pixels\n");
    const RunResult none = folder.compare({"a.exr", "none.exr"});
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.err, ContainsSubstring("cannot read 'none.exr'"));
    CHECK(folder.compare({"a.exr"}).exit_code == 2);

    const RunResult quiet = folder.compare({"bright.exr", "b.exr", "--quiet"});
    CHECK(quiet.exit_code == 3);
    CHECK(quiet.out.empty());
}

TEST_CASE("compare broken files", "[cli][compare]")
{
    const PictureFolder folder;
    for (const char* name : {"a.exr", "truth.png"}) {
        const std::string bytes = read_bytes(folder / name);
        folder.write(std::string("cut ") + name, bytes.substr(0, bytes.size() / 2));
        const RunResult cut = folder.compare({std::string("cut ") + name, "b.exr"});
        CHECK(cut.exit_code == 1);
        CHECK_THAT(cut.err, ContainsSubstring(std::string("cannot read 'cut ") + name + "'"));
    }
}

TEST_CASE("what compare is told decides", "[cli][compare]")
{
    const PictureFolder folder;
    CHECK(folder.compare({"a.exr", "truth.exr"}).exit_code == 4);
    CHECK(folder.compare({"a.exr", "truth.exr", "--exact", "B"}).exit_code == 0);
    CHECK(folder.compare({"bright.exr", "truth.exr", "--exact", "B"}).exit_code == 3);
    CHECK(folder.compare({"bright.exr", "b.exr", "--no-verdict", "--max", "rmse=1,flip=0.9"}).exit_code == 0);
    const RunResult limit = folder.compare({"a.exr", "b.exr", "--max", "rmse=1,mae=0.01", "--max", "psnr=1"});
    CHECK(limit.exit_code == 3);
    CHECK_THAT(limit.out, ContainsSubstring("rmse <= 1: kept\n"));
    CHECK_THAT(limit.out, ContainsSubstring("mae <= 0.01: exceeded\n"));
    CHECK_THAT(limit.out, ContainsSubstring("psnr >= 1: kept\n"));
    // 8 bits, decoded to linear: white is 1.
    const RunResult png = folder.compare({"truth.png", "truth.png", "--flip", "none"});
    CHECK(png.exit_code == 0);
    CHECK_THAT(png.out, ContainsSubstring("mean luminance   1 and 1\n"));
    CHECK(png.out.find("flip") == std::string::npos);
    CHECK_THAT(folder.compare({"truth.png", "truth.png"}).out, ContainsSubstring("(LDR)"));
}

TEST_CASE("compare writes a picture and JSON", "[cli][compare]")
{
    const PictureFolder folder;
    const RunResult result =
        folder.compare({"bright.exr", "b.exr", "--diff", "d.png", "--json", "c.json", "--max", "rmse=0.5"});
    CHECK(result.exit_code == 3);
    CHECK(read_image(folder / "d.png", true).full_width() == 96);
    const std::string json = read_bytes(folder / "c.json");
    for (const char* part :
         {"\"outcome\": \"differs\"", "\"finding\": \"different\"", "\"detectable_bias\": 0.0",
          "\"without_noise\": {", "\"scales\": [", "\"metric\": \"rmse\"", "\"only_a\": 0"})
        CHECK_THAT(json, ContainsSubstring(part));
    const RunResult printed = folder.compare({"a.exr", "b.exr", "--json", "-"});
    CHECK(printed.exit_code == 0);
    CHECK(printed.out.starts_with("{\n"));
    CHECK(printed.out.ends_with("}\n"));
    CHECK(folder.compare({"a.exr", "b.exr", "--diff", "f.png", "--diff-of", "flip"}).exit_code == 0);
    CHECK(folder.compare({"a.exr", "b.exr", "--diff", "nowhere/f.png"}).exit_code == 1);
}
