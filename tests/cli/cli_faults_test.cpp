// SPDX-License-Identifier: MIT

// What goes wrong around a long rendering: disks, directories, memory, and files that change meanwhile.

#include "build_paths.h"
#include "cli/small_scene.h"
#include "support/catch.h"

#include <chrono>
#include <thread>

using namespace plumb;

namespace {

// In a shell with a limit: "ulimit -f 40".
RunResult run_limited(const SceneDirectory& directory, const std::string& limit, const Names& words)
{
    Names all = {"/bin/sh", "-c", limit + R"( && exec "$@")", "sh", PLUMB_RENDERER};
    all.insert(all.end(), words.begin(), words.end());
    return run_program(all, directory.path());
}

// Waits until the file is there: rendering has begun.
Meanwhile once_there(const std::filesystem::path& file, const std::function<void()>& act)
{
    return [file, act](pid_t) {
        for (int i = 0; i < 3000 && !std::filesystem::exists(file); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        act();
    };
}

// What a rendering says while the directory `gone` vanishes.
RunResult lose_directory(const SceneDirectory& directory, const std::string& gone, const std::string& output,
                         const std::string& checkpoint)
{
    std::filesystem::create_directory(directory / gone);
    return run_renderer({"scene.xml", "--quiet", "--spp", "40000", "--crop", "20,16,4,4", "-o", output,
                         "--checkpoint", checkpoint, "--checkpoint-every", "0.05s"},
                        directory.path(), "", once_there(directory / checkpoint, [&] {
                            std::filesystem::remove_all(directory / gone);
                        }));
}

} // namespace

TEST_CASE("a disk that is full leaves the last checkpoint", "[cli][faults]")
{
    const SceneDirectory directory;
    REQUIRE(directory.run({"scene.xml", "-o", "a.exr", "--crop", "0,0,40,30", "--checkpoint", "c.exr"})
                .exit_code == 0);
    const std::string before = read_bytes(directory / "c.exr");
    const auto files = directory.files();
    // 4 kB: too little for either file.
    const RunResult full = run_limited(directory, "ulimit -f 4",
                                       {"scene.xml", "-o", "a.exr", "--crop", "0,0,40,30", "--checkpoint",
                                        "c.exr", "--resume", "--spp", "9", "--quiet"});
    CHECK(full.exit_code == 1);
    CHECK(full.err ==
          "error: cannot write 'c.exr': File too large and cannot write 'a.exr': File too large\n");
    CHECK(read_bytes(directory / "c.exr") == before);
    CHECK(directory.files() == files); // and nothing half-written
}

TEST_CASE("a checkpoint that cannot be written does not lose the image", "[cli][faults]")
{
    const SceneDirectory directory;
    REQUIRE(
        directory.run({"scene.xml", "-o", "whole.exr", "--quiet", "--spp", "40000", "--crop", "20,16,4,4"})
            .exit_code == 0);
    const RunResult result = lose_directory(directory, "gone", "a.exr", "gone/c.exr");
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err,
               ContainsSubstring(
                   "warning: cannot write 'gone/c.exr': No such file or directory; rendering continues\n"));
    CHECK_THAT(result.err,
               ContainsSubstring("error: cannot write 'gone/c.exr': No such file or directory\n"));
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));
}

TEST_CASE("an image whose directory vanished is put beside the checkpoint", "[cli][faults]")
{
    const SceneDirectory directory;
    std::filesystem::create_directory(directory / "kept");
    std::filesystem::create_directory(directory / "gone");
    const RunResult result = run_renderer(
        {"scene.xml", "--quiet", "--spp", "40000", "--crop", "20,16,4,4", "-o", "gone/a.exr", "--checkpoint",
         "kept/c.exr", "--checkpoint-every", "0.05s"},
        directory.path(), "",
        once_there(directory / "kept/c.exr", [&] { std::filesystem::remove_all(directory / "gone"); }));
    CHECK(result.exit_code == 1);
    CHECK(result.err == "error: cannot write 'gone/a.exr': the directory 'gone' does not exist; the image "
                        "was written to 'kept/a.exr' instead\n");
    REQUIRE(
        directory.run({"scene.xml", "-o", "whole.exr", "--quiet", "--spp", "40000", "--crop", "20,16,4,4"})
            .exit_code == 0);
    CHECK(read_bytes(directory / "kept/a.exr") == read_bytes(directory / "whole.exr"));
}

TEST_CASE("a scene that is edited while it is rendered is not resumed", "[cli][faults]")
{
    const SceneDirectory directory;
    REQUIRE(
        directory.run({"scene.xml", "-o", "whole.exr", "--quiet", "--spp", "40000", "--crop", "20,16,4,4"})
            .exit_code == 0);
    const Names words = {"scene.xml",          "--quiet", "--spp", "40000",        "--crop",
                         "20,16,4,4",          "-o",      "a.exr", "--checkpoint", "c.exr",
                         "--checkpoint-every", "0.05s"};
    const RunResult result =
        run_renderer(words, directory.path(), "", once_there(directory / "c.exr", [&] {
                         directory.write("scene.xml", small_scene(R"(<integrator type="path"/>)"));
                     }));
    // The image is that of the scene as it was read.
    REQUIRE(result.exit_code == 0);
    CHECK(read_bytes(directory / "a.exr") == read_bytes(directory / "whole.exr"));
    Names more = words;
    more.emplace_back("--resume");
    const RunResult again = directory.run(more);
    CHECK(again.exit_code == 1);
    CHECK_THAT(again.err, ContainsSubstring("error: cannot resume from 'c.exr': 'scene.xml' has changed"));
}

// The address space that a sanitizer wants is not to be had in little memory.
#if !defined(__SANITIZE_ADDRESS__)
TEST_CASE("too little memory is an error wherever it is met", "[cli][faults]")
{
    const SceneDirectory directory;
    int failures = 0;
    for (int megabytes = 100; megabytes <= 1200; megabytes += megabytes < 300 ? 20 : 100) {
        const RunResult result = run_limited(directory, "ulimit -v " + std::to_string(megabytes * 1000),
                                             {"scene.xml", "-o", "a.exr", "--size", "1500x1000", "--crop",
                                              "0,0,1500,10", "--spp", "1", "--quiet", "--threads", "1"});
        INFO(megabytes << " MB: " << result.err);
        REQUIRE((result.exit_code == 0 || result.exit_code == 1 ||
                 result.exit_code == 127)); // 127: not even loaded
        if (result.exit_code != 1) continue;
        ++failures;
        CHECK(result.err.find("memory") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(directory / "a.exr"));
    }
    CHECK(failures > 0);
}
#endif
