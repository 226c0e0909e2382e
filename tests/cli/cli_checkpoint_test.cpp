// SPDX-License-Identifier: MIT

// Checkpoints, stop rules, parts and merging, with the real program.

#include "cli/image_header.h"
#include "cli/small_scene.h"
#include "plumb/image/image.h"
#include "plumb/render/state_file.h"
#include "support/catch.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <set>
#include <thread>

using namespace plumb;

namespace {

bool is_there(const std::filesystem::path& path)
{
    return std::filesystem::exists(path);
}

} // namespace

TEST_CASE("a resumed rendering gives the same file", "[cli][checkpoint]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "whole.exr", "--spp", "50"}).exit_code == 0);
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--spp", "20", "--checkpoint", "c.exr"}).exit_code ==
            0);
    const RunResult more =
        directory.run({"scene.xml", "-o", "a.exr", "--spp", "50", "--checkpoint", "c.exr", "--resume"});
    CHECK(more.exit_code == 0);
    CHECK_THAT(more.err, ContainsSubstring("resuming from 'c.exr', which has 34.5 k samples\n"));
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));
    CHECK(is_there(directory / "c.previous.exr"));

    SECTION("from nothing it starts, and says so")
    {
        const RunResult fresh =
            directory.run({"scene.xml", "-o", "b.exr", "--spp", "50", "--checkpoint", "d.exr", "--resume"});
        CHECK(fresh.exit_code == 0);
        CHECK_THAT(fresh.err,
                   ContainsSubstring("'d.exr' does not exist yet; starting with the first sample\n"));
        CHECK(read_bytes(directory / "b.exr") == read_bytes(directory / "whole.exr"));
    }
    SECTION("a checkpoint is not written over by a new rendering")
    {
        const RunResult other =
            directory.run({"scene.xml", "-o", "b.exr", "--spp", "60", "--checkpoint", "c.exr"});
        CHECK(other.exit_code == 1);
        CHECK(other.err == "error: 'c.exr' already exists; pass --resume to continue it, or remove it\n");
    }
    SECTION("nor is one of which only the previous generation is left")
    {
        std::filesystem::remove(directory / "c.exr");
        const RunResult other =
            directory.run({"scene.xml", "-o", "b.exr", "--spp", "60", "--checkpoint", "c.exr"});
        CHECK(other.exit_code == 1);
        CHECK(other.err ==
              "error: 'c.previous.exr' already exists; pass --resume to continue it, or remove it\n");
        CHECK(directory.run({"scene.xml", "-o", "b.exr", "--spp", "50", "--checkpoint", "c.exr", "--resume"})
                  .exit_code == 0);
        CHECK(read_bytes(directory / "b.exr") == read_bytes(directory / "whole.exr"));
    }
    SECTION("a damaged generation is said to be so, and the previous one taken")
    {
        const std::string good = read_bytes(directory / "c.exr");
        directory.write("c.exr", good.substr(0, good.size() / 2));
        const RunResult second =
            directory.run({"scene.xml", "-o", "a.exr", "--spp", "50", "--checkpoint", "c.exr", "--resume"});
        CHECK(second.exit_code == 0);
        CHECK_THAT(second.err, ContainsSubstring("warning: cannot resume from 'c.exr': "));
        CHECK_THAT(second.err, ContainsSubstring("; resuming from 'c.previous.exr'\n"));
        CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));

        directory.write("c.exr", "nothing");
        directory.write("c.previous.exr", "nothing");
        const RunResult third =
            directory.run({"scene.xml", "-o", "a.exr", "--spp", "50", "--checkpoint", "c.exr", "--resume"});
        CHECK(third.exit_code == 1);
        CHECK_THAT(third.err, ContainsSubstring("error: cannot resume from 'c.exr': "));
        CHECK_THAT(third.err, ContainsSubstring("; and the previous checkpoint: "));
        CHECK(read_bytes(directory / "c.exr") == "nothing");
    }
}

TEST_CASE("a checkpoint of another rendering is refused with the reason", "[cli][checkpoint]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--checkpoint", "c.exr"}).exit_code == 0);
    const std::string before = read_bytes(directory / "c.exr");
    const auto refusal = [&](Names words) {
        words.insert(words.end(), {"--checkpoint", "c.exr", "--resume", "-o", "b.exr", "--quiet"});
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 1);
        CHECK(result.out.empty());
        CHECK(read_bytes(directory / "c.exr") == before);
        return result.err;
    };
    CHECK(refusal({"scene.xml", "--seed", "3"}) ==
          "error: cannot resume from 'c.exr': the seed was 0 and is 3\n");
    CHECK(refusal({"scene.xml", "--isa", "sse4.2", "--integrator", "path"}) ==
          "error: cannot resume from 'c.exr': the integrator was path_mis and is path and the instruction "
          "set was avx2 and is sse4.2\n");
    CHECK(refusal({"scene.xml", "--size", "20x20"}) ==
          "error: cannot resume from 'c.exr': the resolution was the default and is 20x20\n");
    CHECK(refusal({"scene.xml", "--crop", "0,0,8,8"}) ==
          "error: cannot resume from 'c.exr': it has the pixels 0,0,48,36, not 0,0,8,8\n");
    CHECK(refusal({"scene.xml", "--spp", "2"}) ==
          "error: cannot resume from 'c.exr': it has samples that were not requested: 0,0,48,36:2-4\n");
    directory.write("scene.xml", small_scene() + "<!-- edited -->");
    CHECK(refusal({"scene.xml"}) == "error: cannot resume from 'c.exr': 'scene.xml' has changed\n");
    directory.write("scene.xml", small_scene());
    std::filesystem::copy_file(directory / "a.exr", directory / "c.exr",
                               std::filesystem::copy_options::overwrite_existing);
    CHECK_THAT(directory.run({"scene.xml", "-o", "b.exr", "--checkpoint", "c.exr", "--resume"}).err,
               ContainsSubstring("cannot resume from 'c.exr': it is not a checkpoint or a partial render"));
}

TEST_CASE("a signal ends a rendering with image and checkpoint", "[cli][checkpoint]")
{
    const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGXCPU);
    const SceneDirectory directory;
    REQUIRE(
        directory.run({"scene.xml", "-o", "whole.exr", "--spp", "40000", "--crop", "20,16,4,4"}).exit_code ==
        0);
    const Names words = {"scene.xml", "-o",        "a.exr",        "--spp", "40000",
                         "--crop",    "20,16,4,4", "--checkpoint", "c.exr"};
    // The first checkpoint shows that rendering has begun.
    Names often = words;
    often.insert(often.end(), {"--checkpoint-every", "0.01s"});
    // On a busy machine the rendering may end before the signal comes, or have no sample by then.
    RunResult stopped;
    RunResult same;
    const auto is_too_late_or_early = [&] {
        return stopped.exit_code == 0 || same.err.find("has no samples") != std::string::npos;
    };
    for (int attempt = 0; attempt == 0 || (attempt < 10 && is_too_late_or_early()); ++attempt) {
        for (const char* file : {"a.exr", "c.exr", "c.previous.exr"})
            std::filesystem::remove(directory / file);
        stopped = run_renderer(often, directory.path(), "", [&](pid_t process) {
            for (int i = 0; i < 3000 && !is_there(directory / "c.exr"); ++i)
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
            kill(process, signal);
        });
        same = directory.run({"rerun", "a.exr", "-o", "same.exr"});
    }
    REQUIRE(stopped.exit_code == 128 + signal);
    CHECK_THAT(stopped.err, ContainsSubstring("samples per pixel; to resume:\n"
                                              "    renderer scene.xml -o a.exr --spp 40000 --crop 20,16,4,4 "
                                              "--checkpoint c.exr --checkpoint-every 0.01s --resume\n"));
    CHECK(text(header(directory / "a.exr"), "plumb:stop") == "it was interrupted");
    CHECK(text(header(directory / "a.exr"), "compression") == "rle"); // quickly
    INFO(same.err);
    REQUIRE(same.exit_code == 0);
    CHECK(read_bytes(directory / "same.exr") == read_bytes(directory / "a.exr"));
    Names again = words;
    again.emplace_back("--resume");
    REQUIRE(directory.run(again).exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));
}

TEST_CASE("a rendering ends when its noise is low enough, wherever it was interrupted", "[cli][checkpoint]")
{
    const SceneDirectory directory;
    const Names words = {"scene.xml", "--size", "16x12", "--target-error", "0.2"};
    const auto with = [&](const Names& more) {
        Names all = words;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    REQUIRE(directory.run(with({"-o", "whole.exr"})).exit_code == 0);
    const auto found = header(directory / "whole.exr");
    const int samples = integer(found, "plumb:samplesPerPixel");
    CHECK(samples >= 16);
    CHECK(samples % 16 == 0);
    CHECK(integer(found, "plumb:biased") == 1);
    CHECK(text(found, "plumb:biases") == "it stopped when its measured noise was below 0.2");

    REQUIRE(
        directory.run({"scene.xml", "--size", "16x12", "--spp", "21", "-o", "a.exr", "--checkpoint", "c.exr"})
            .exit_code == 0);
    REQUIRE(directory.run(with({"-o", "a.exr", "--checkpoint", "c.exr", "--resume"})).exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));
    REQUIRE(directory.run({"rerun", "whole.exr", "-o", "again.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "again.exr") == read_bytes(directory / "whole.exr"));
}

TEST_CASE("a time limit is kept, named in the ledger, and can be rendered again", "[cli][checkpoint]")
{
    const SceneDirectory directory;
    const RunResult limited = directory.run({"scene.xml", "-o", "a.exr", "--time", "0.3"});
    REQUIRE(limited.exit_code == 0);
    const auto found = header(directory / "a.exr");
    CHECK(text(found, "plumb:biases") == "it stopped at the time limit of 0.300 s");
    CHECK(integer(found, "plumb:samplesPerPixel") >= 1);
    REQUIRE(directory.run({"rerun", "a.exr", "-o", "b.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "b.exr"));
    // The number of samples is a limit, too.
    REQUIRE(directory.run({"scene.xml", "-o", "c.exr", "--time", "1h", "--spp", "3"}).exit_code == 0);
    CHECK(integer(header(directory / "c.exr"), "plumb:samplesPerPixel") == 3);
    CHECK(integer(header(directory / "c.exr"), "plumb:biased") == 0);
}

TEST_CASE("parts make the image, whatever the order and the grouping", "[cli][merge]")
{
    const SceneDirectory directory;
    const std::string by = GENERATE("tiles", "samples");
    REQUIRE(directory.run({"scene.xml", "-o", "whole.exr", "--spp", "9"}).exit_code == 0);
    for (const std::string part : {"1", "2", "3", "4"})
        REQUIRE(directory
                    .run({"scene.xml", "--spp", "9", "--part", part + "/4", "--part-by", by, "-o",
                          "p" + part + ".exr"})
                    .exit_code == 0);
    REQUIRE(directory.run({"merge", "p3.exr", "p1.exr", "p4.exr", "p2.exr", "-o", "a.exr"}).exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));
    REQUIRE(directory.run({"merge", "p3.exr", "p1.exr", "--checkpoint", "p13.exr"}).exit_code == 0);
    REQUIRE(directory.run({"merge", "p2.exr", "p13.exr", "--checkpoint", "p123.exr"}).exit_code == 0);
    REQUIRE(
        directory.run({"merge", "p4.exr", "p123.exr", "-o", "b.exr", "--checkpoint", "all.exr"}).exit_code ==
        0);
    CHECK(read_bytes(directory / "b.exr") == read_bytes(directory / "whole.exr"));

    // The whole can be resumed.
    REQUIRE(directory.run({"scene.xml", "-o", "whole.exr", "--spp", "12"}).exit_code == 0);
    REQUIRE(directory.run({"scene.xml", "-o", "c.exr", "--spp", "12", "--checkpoint", "all.exr", "--resume"})
                .exit_code == 0);
    CHECK(read_bytes(directory / "c.exr") == read_bytes(directory / "whole.exr"));

    SECTION("overlaps and holes are refused by name")
    {
        const auto refusal = [&](const Names& words) {
            const RunResult result = directory.run(words);
            CHECK(result.exit_code == 1);
            CHECK_FALSE(is_there(directory / "x.exr"));
            return result.err;
        };
        CHECK_THAT(refusal({"merge", "p1.exr", "p13.exr", "p2.exr", "-o", "x.exr"}),
                   ContainsSubstring("error: 'p1.exr' and 'p13.exr' both contain "));
        CHECK_THAT(refusal({"merge", "p1.exr", "p13.exr", "-o", "x.exr"}),
                   ContainsSubstring(" samples, the first "
                                     "of them at 0,0,"));
        CHECK_THAT(refusal({"merge", "p13.exr", "p4.exr", "-o", "x.exr"}),
                   ContainsSubstring("samples are missing (part 2/4 by " + by + "), the first of them at "));
        REQUIRE(directory.run({"scene.xml", "--spp", "9", "--part", "4/4", "--seed", "2", "-o", "other.exr"})
                    .exit_code == 0);
        CHECK(refusal({"merge", "p123.exr", "other.exr", "-o", "x.exr"}) ==
              "error: 'p123.exr' and 'other.exr' are not parts of one image: the seed was 0 and is 2\n");
        REQUIRE(directory.run({"scene.xml", "--spp", "10", "--part", "4/4", "-o", "longer.exr"}).exit_code ==
                0);
        CHECK(refusal({"merge", "p123.exr", "longer.exr", "-o", "x.exr"}) ==
              "error: 'p123.exr' and 'longer.exr' are not parts of one image: one has 9 samples per pixel, "
              "the other 10\n");
        CHECK(refusal({"merge", "p1.exr", "p2.exr", "--checkpoint", "p1.exr"}) ==
              "error: cannot write 'p1.exr': it is a part to be merged\n");
        CHECK_THAT(refusal({"merge", "p1.exr", "scene.xml", "-o", "x.exr"}),
                   ContainsSubstring("error: cannot merge 'scene.xml': "));
    }
    SECTION("an image with holes says so")
    {
        const RunResult result =
            directory.run({"merge", "p13.exr", "p4.exr", "-o", "x.exr", "--allow-missing"});
        CHECK(result.exit_code == 0);
        CHECK_THAT(result.err, ContainsSubstring("warning: "));
        const auto found = header(directory / "x.exr");
        CHECK(found.count("plumb:samplesTaken") == 1);
        CHECK(integer(found, "plumb:biased") == (by == "tiles" ? 1 : 0));
        if (by == "tiles") CHECK(text(found, "plumb:biases") == "some pixels have no samples and are black");
    }
}

TEST_CASE("what does not go with checkpoints and parts", "[cli][merge]")
{
    const SceneDirectory directory;
    const auto usage = [&](const Names& words) {
        const RunResult result = directory.run(words);
        CHECK(result.exit_code == 2);
        return result.err;
    };
    CHECK(usage({"scene.xml", "--part", "1/2", "-o", "p.exr", "--checkpoint", "c.exr"}) ==
          "error: --part and --checkpoint cannot be used together: the output of a part is its checkpoint\n");
    CHECK(usage({"scene.xml", "--part", "1/2"}) == "error: --part needs one -o,--output FILE.exr\n");
    CHECK(usage({"scene.xml", "--part", "1/2", "-o", "p.png"}) ==
          "error: 'p.png' must end in .exr: checkpoints and parts are .exr files\n");
    CHECK(usage({"scene.xml", "--part", "3/2", "-o", "p.exr"}) ==
          "error: --part must be K/N, part K of N from 1/N to N/N and N at most 65535, not '3/2'\n");
    CHECK(usage({"scene.xml", "--part-by", "tiles", "-o", "p.exr"}) == "error: --part-by needs --part K/N\n");
    CHECK(usage({"scene.xml", "--part", "1/2", "--time", "3", "-o", "p.exr"}) ==
          "error: a part is a fixed set of samples: use --part with --spp, not with --time or "
          "--target-error\n");
    CHECK(usage({"scene.xml", "--resume", "-o", "p.exr"}) == "error: --resume needs --checkpoint FILE\n");
    CHECK(usage({"scene.xml", "--checkpoint", "p.exr", "-o", "p.exr"}) ==
          "error: 'p.exr' is listed as an output twice\n");
    CHECK(usage({"merge", "p.exr"}) ==
          "error: merge needs -o,--output IMAGE, or --checkpoint FILE to merge the result with more parts\n");
}

TEST_CASE("work from before the scene language changed is neither resumed nor merged", "[cli][merge]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--checkpoint", "c.exr", "--quiet"}).exit_code == 0);
    StateFile file = read_state(directory / "c.exr");
    std::erase_if(file.header, [](const auto& entry) { return entry.first == "plumb:language"; });
    const std::vector<unsigned char> bytes = encode_state(file.state, file.resolution, file.header);
    directory.write("c.exr", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const RunResult resumed =
        directory.run({"scene.xml", "-o", "b.exr", "--checkpoint", "c.exr", "--resume", "--quiet"});
    CHECK(resumed.exit_code == 1);
    CHECK(resumed.err ==
          "error: cannot resume from 'c.exr': the version of the scene language was 1 and is 2\n");
    const RunResult merged = directory.run({"merge", "c.exr", "-o", "b.exr", "--quiet"});
    CHECK(merged.exit_code == 1);
    CHECK_THAT(merged.err, ContainsSubstring("'c.exr' was made with version 1 of the scene language") &&
                               ContainsSubstring("directional lights"));
    CHECK_FALSE(std::filesystem::exists(directory / "b.exr"));
}

namespace {

// Sends the signals one after the other to a rendering that has begun, of a scene that takes long.
RunResult run_and_signal(const SceneDirectory& directory, Names words, const std::vector<int>& signals)
{
    return run_program(words, directory.path(), "", [&](pid_t process) {
        for (int i = 0; i < 3000 && !is_there(directory / "c.exr"); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        for (const int signal : signals) {
            kill(process, signal);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    });
}

} // namespace

TEST_CASE("signals that come in series do not lose the last checkpoint", "[cli][checkpoint]")
{
    const SceneDirectory directory;
    const Names words = {PLUMB_RENDERER,
                         "scene.xml",
                         "-o",
                         "a.exr",
                         "--spp",
                         "400000",
                         "--crop",
                         "20,16,4,4",
                         "--checkpoint",
                         "c.exr",
                         "--checkpoint-every",
                         "0.01s"};
    // The shell and the terminal both tell of a hang-up; SIGXCPU comes every second.
    const RunResult stopped = run_and_signal(directory, words, {SIGHUP, SIGHUP, SIGXCPU, SIGUSR1});
    // If they wait together, on a busy machine, any thread may take any of them first.
    const std::set<int> signals = {SIGHUP, SIGXCPU, SIGUSR1};
    CHECK(signals.count(stopped.exit_code - 128) == 1);
    CHECK_THAT(stopped.err, ContainsSubstring("; to resume:"));
    CHECK(is_there(directory / "a.exr"));
}

TEST_CASE("a signal that nohup ignores stays ignored", "[cli][checkpoint]")
{
    const SceneDirectory directory;
    const Names words = {"/bin/sh", "-c",
                         "trap '' HUP; exec \"$0\" scene.xml -o a.exr --spp 400000 --crop 20,16,4,4 "
                         "--checkpoint c.exr --checkpoint-every 0.01s",
                         PLUMB_RENDERER};
    CHECK(run_and_signal(directory, words, {SIGHUP, SIGTERM}).exit_code == 128 + SIGTERM);
}

TEST_CASE("parts of processors of different vendors are merged with --mixed", "[cli][merge]")
{
    const SceneDirectory directory;
    const auto part = [&](const std::string& which, const std::string& file) {
        return directory.run({"scene.xml", "--part", which, "-o", file, "--quiet"}).exit_code;
    };
    REQUIRE(part("1/2", "p1.exr") == 0);
    REQUIRE(part("2/2", "p2.exr") == 0);
    REQUIRE(directory.run({"merge", "p1.exr", "p2.exr", "-o", "same.exr", "--quiet"}).exit_code == 0);
    const std::string here = text(header(directory / "same.exr"), "plumb:processor");
    const std::string there = here == "GenuineIntel" ? "AuthenticAMD" : "GenuineIntel";
    const std::string both = here < there ? here + ", " + there : there + ", " + here;
    StateFile second = read_state(directory / "p2.exr");
    for (auto& [name, value] : second.header)
        if (name == "plumb:processor") value = there;
    const std::vector<unsigned char> bytes = encode_state(second.state, second.resolution, second.header);
    std::ofstream(directory / "p2.exr", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));

    const RunResult refused = directory.run({"merge", "p1.exr", "p2.exr", "-o", "a.exr"});
    CHECK(refused.exit_code == 1);
    CHECK(refused.err ==
          "error: 'p1.exr' and 'p2.exr' are not parts of one image: the processor vendor was " + here +
              " and is " + there + "; pass --mixed to merge them without the promise of equal bits\n");
    CHECK_FALSE(is_there(directory / "a.exr"));

    for (const bool first : {true, false}) {
        const Names parts = first ? Names{"p1.exr", "p2.exr"} : Names{"p2.exr", "p1.exr"};
        REQUIRE(
            directory.run({"merge", parts[0], parts[1], "--mixed", "-o", "mixed.exr", "--quiet"}).exit_code ==
            0);
        CHECK(text(header(directory / "mixed.exr"), "plumb:processor") == both);
        CHECK(
            directory.run({"compare", "mixed.exr", "same.exr", "--no-verdict", "--max", "max=0"}).exit_code ==
            0);
    }
    // What is mixed stays so.
    REQUIRE(directory.run({"merge", "p1.exr", "p2.exr", "--mixed", "--checkpoint", "both.exr"}).exit_code ==
            0);
    CHECK(directory.run({"scene.xml", "--checkpoint", "both.exr", "--resume", "-o", "b.exr"}).exit_code == 1);
}
