// SPDX-License-Identifier: MIT

// `renderer compare`: what it prints and how it ends.

#include "plumb/image/image.h"
#include "support/catch.h"
#include "support/noisy_image.h"
#include "support/run.h"

using namespace plumb;
using namespace plumb::test;

namespace {

struct ImageDirectory : TempDirectory {
    ImageDirectory()
    {
        NoisyImage how;
        how.size = 32;
        how.channels = {"R", "G", "B"};
        write_image(path() / "a.exr", noisy_image(how, exponential_samples(), 1));
        write_image(path() / "b.exr", noisy_image(how, exponential_samples(), 2));
        write_image(path() / "few.exr", noisy_image(how, hits(1e-4), 3));
        how.bias = 1.2;
        write_image(path() / "bright.exr", noisy_image(how, exponential_samples(), 4));
        how.size = 16;
        write_image(path() / "small.exr", noisy_image(how, exponential_samples(), 5));
        how.size = 32;
        how.bias = 1.0;
        write_image(path() / "truth.exr", true_image(how));
        write_image(path() / "truth.png", true_image(how));
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
    const ImageDirectory directory;
    const RunResult same = directory.compare({"a.exr", "b.exr"});
    INFO(same.out << same.err);
    CHECK(same.exit_code == 0);
    CHECK(same.err.empty());
    CHECK(same.out.starts_with("A a.exr\nB b.exr\n  mse "));
    CHECK(same.out.ends_with("\npasses\n"));
    CHECK_THAT(same.out, ContainsSubstring("no difference beyond the noise at significance 0.01\n"));
    CHECK_THAT(same.out, ContainsSubstring("would have been found with 90 % probability\n"));

    const RunResult bright = directory.compare({"bright.exr", "b.exr"});
    CHECK(bright.exit_code == 3);
    CHECK(bright.out.ends_with("\ndiffers\n"));
    CHECK_THAT(bright.out, ContainsSubstring("a difference beyond the noise"));

    const RunResult few = directory.compare({"few.exr", "b.exr"});
    CHECK(few.exit_code == 4);
    CHECK(few.out.ends_with("\nundecided\n"));
    CHECK_THAT(few.out,
               ContainsSubstring("1024 of 1024 pixels lie in no square where the samples support a test"));

    const RunResult sizes = directory.compare({"small.exr", "b.exr"});
    CHECK(sizes.exit_code == 1);
    CHECK(sizes.err == "error: the images have different sizes: A is 16x16 pixels, B is 32x32 pixels\n");
    const RunResult none = directory.compare({"a.exr", "none.exr"});
    CHECK(none.exit_code == 1);
    CHECK_THAT(none.err, ContainsSubstring("cannot read 'none.exr'"));
    CHECK(directory.compare({"a.exr"}).exit_code == 2);

    const RunResult quiet = directory.compare({"bright.exr", "b.exr", "--quiet"});
    CHECK(quiet.exit_code == 3);
    CHECK(quiet.out.empty());
}

TEST_CASE("compare broken files", "[cli][compare]")
{
    const ImageDirectory directory;
    for (const char* name : {"a.exr", "truth.png"}) {
        const std::string bytes = read_bytes(directory / name);
        directory.write(std::string("cut ") + name, bytes.substr(0, bytes.size() / 2));
        const RunResult cut = directory.compare({std::string("cut ") + name, "b.exr"});
        CHECK(cut.exit_code == 1);
        CHECK_THAT(cut.err, ContainsSubstring(std::string("cannot read 'cut ") + name + "'"));
    }
}

TEST_CASE("what compare is told decides", "[cli][compare]")
{
    const ImageDirectory directory;
    const RunResult single = directory.compare({"a.exr", "truth.exr"});
    CHECK(single.exit_code == 4);
    CHECK_THAT(
        single.out,
        ContainsSubstring(
            "  error bars       A variance channels, B none: the spread of A - B tells of the noise\n"));
    CHECK_THAT(single.out,
               ContainsSubstring(
                   "  noise            undecided: B shows no noise of its own beside that of A, as after a "
                   "denoiser; if it has none, pass --exact B\n"));
    const RunResult png = directory.compare({"truth.png", "b.exr"});
    CHECK(png.exit_code == 4);
    CHECK_THAT(png.out, ContainsSubstring(
                            "undecided: A is rounded to integers and clipped at 1, which changes its means; "
                            "write it as .exr, or pass --exact A if it has no noise\n"));
    CHECK(directory.compare({"a.exr", "truth.exr", "--exact", "B"}).exit_code == 0);
    CHECK(directory.compare({"bright.exr", "truth.exr", "--exact", "B"}).exit_code == 3);
    CHECK(directory.compare({"bright.exr", "b.exr", "--no-verdict", "--max", "rmse=1,flip=0.9"}).exit_code ==
          0);
    const RunResult limit =
        directory.compare({"a.exr", "b.exr", "--max", "rmse=1,mae=0.01", "--max", "psnr=1"});
    CHECK(limit.exit_code == 3);
    CHECK_THAT(limit.out, ContainsSubstring("rmse <= 1: kept\n"));
    CHECK_THAT(limit.out, ContainsSubstring("mae <= 0.01: exceeded\n"));
    CHECK_THAT(limit.out, ContainsSubstring("psnr >= 1: kept\n"));
    // 8 bits, decoded to linear: white is 1.
    const RunResult screens = directory.compare({"truth.png", "truth.png", "--flip", "none"});
    CHECK(screens.exit_code == 0);
    CHECK_THAT(screens.out, ContainsSubstring("mean luminance   1 and 1\n"));
    CHECK(screens.out.find("flip") == std::string::npos);
    CHECK_THAT(directory.compare({"truth.png", "truth.png"}).out, ContainsSubstring("(LDR)"));
}

TEST_CASE("compare takes replicas", "[cli][compare]")
{
    const ImageDirectory directory;
    NoisyImage how;
    how.size = 32;
    how.channels = {"R", "G", "B"};
    how.knows_noise = false;
    for (const int k : {1, 2, 3})
        write_image(directory / ("r" + std::to_string(k) + ".exr"),
                    noisy_image(how, exponential_samples(), 20 + static_cast<std::uint64_t>(k)));
    const RunResult same = directory.compare({"r1.exr", "r2.exr", "--against", "b.exr"});
    INFO(same.out << same.err);
    CHECK(same.exit_code == 0);
    CHECK(same.out.starts_with("A r1.exr r2.exr\nB b.exr\n"));
    CHECK_THAT(same.out, ContainsSubstring("  error bars       A 2 replicas, B variance channels\n"));
    const RunResult both = directory.compare(
        {"a.exr", "bright.exr", "--against", "r1.exr", "--against", "r2.exr", "--json", "-"});
    CHECK_THAT(both.out, ContainsSubstring("\"error_bars_b\": \"2 replicas\""));

    const RunResult named = directory.compare({"r{replica}.exr", "--replicas", "2", "b.exr"});
    CHECK(named.exit_code == 0);
    CHECK(named.out == same.out);
    const RunResult reference = directory.compare({"a.exr", "r{replica}.exr", "--replicas", "3"});
    CHECK_THAT(reference.out, ContainsSubstring("B r1.exr r2.exr r3.exr\n"));
    CHECK_THAT(directory.compare({"a.exr", "b.exr", "--replicas", "2"}).err,
               ContainsSubstring(
                   "error: --replicas needs a name with {replica} in it, such as 'mine_{replica}.exr'\n"));
    // What a shell makes of --against r*.exr.
    const RunResult glob = directory.compare({"a.exr", "--against", "r1.exr", "r2.exr"});
    CHECK(glob.exit_code == 2);
    CHECK_THAT(glob.err,
               ContainsSubstring("error: 'r2.exr' is behind --against, so it may be of A or of B; "));
    CHECK(directory.compare({"--against", "b.exr", "r1.exr", "r2.exr"}).out == same.out);

    const RunResult identical = directory.compare({"r1.exr", "r2.exr", "r1.exr", "--against", "b.exr"});
    CHECK(identical.exit_code == 1);
    CHECK(identical.err == "error: A1 and A3 have the same pixels; replicas need different seeds\n");
    const RunResult three = directory.compare({"r1.exr", "r2.exr", "b.exr"});
    CHECK(three.exit_code == 2);
    CHECK_THAT(three.err,
               ContainsSubstring("3 images are given; pass the reference with --against FILE, the others are "
                                 "then replicas of A"));
    const RunResult one = directory.compare({"r1.exr"});
    CHECK(one.exit_code == 2);
    CHECK_THAT(one.err, ContainsSubstring("compare needs two images; 'renderer compare --help' shows how"));
}

TEST_CASE("a p-value is never 0, and compare names what agrees", "[cli][compare]")
{
    const ImageDirectory directory;
    NoisyImage how;
    how.size = 64;
    how.samples = 100000;
    how.channels = {"R", "G", "B"};
    write_image(directory / "c.exr", noisy_image(how, rare_light(0.0, 0.5), 31));
    how.bias = 2.0;
    write_image(directory / "d.exr", noisy_image(how, rare_light(0.0, 0.5), 32));
    const RunResult result = directory.compare({"c.exr", "d.exr"});
    INFO(result.out);
    CHECK(result.exit_code == 3);
    CHECK_THAT(result.out, ContainsSubstring("< 1e-300"));
    CHECK_THAT(result.out, ContainsSubstring("  alignment        A times 2 agrees with B (p "));
    CHECK_THAT(result.out, ContainsSubstring("27 changes tried)\n"));
}

TEST_CASE("compare writes an image and JSON", "[cli][compare]")
{
    const ImageDirectory directory;
    const RunResult result = directory.compare(
        {"bright.exr", "b.exr", "--diff", "d.png", "--json", "c.json", "--max", "rmse=0.5"});
    CHECK(result.exit_code == 3);
    CHECK(read_image(directory / "d.png", true).full_width() == 96);
    const std::string json = read_bytes(directory / "c.json");
    for (const char* part :
         {"\"outcome\": \"differs\"", "\"finding\": \"different\"", "\"detectable_bias\": 0.0",
          "\"without_noise\": {", "\"scales\": [", "\"metric\": \"rmse\"", "\"only_a\": 0"})
        CHECK_THAT(json, ContainsSubstring(part));
    const RunResult printed = directory.compare({"a.exr", "b.exr", "--json", "-"});
    CHECK(printed.exit_code == 0);
    CHECK(printed.out.starts_with("{\n"));
    CHECK(printed.out.ends_with("}\n"));
    CHECK(directory.compare({"a.exr", "b.exr", "--diff", "f.png", "--diff-of", "flip"}).exit_code == 0);
    CHECK(directory.compare({"a.exr", "b.exr", "--diff", "nowhere/f.png"}).exit_code == 1);
}
