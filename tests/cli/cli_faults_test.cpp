// SPDX-License-Identifier: MIT

// What goes wrong around a long rendering: disks, folders, memory, and files that change meanwhile.

#include "build_paths.h"
#include "cli/small_scene.h"
#include "support/catch.h"

#include <chrono>
#include <thread>

using namespace plumb;

namespace {

// In a shell with a limit: "ulimit -f 40".
RunResult run_limited(const SceneFolder& folder, const std::string& limit, const Names& words)
{
    Names all = {"/bin/sh", "-c", limit + R"( && exec "$@")", "sh", PLUMB_RENDERER};
    all.insert(all.end(), words.begin(), words.end());
    return run_program(all, folder.path());
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

// What a rendering says while the folder `gone` vanishes.
RunResult lose_folder(const SceneFolder& folder, const std::string& gone, const std::string& output,
                      const std::string& checkpoint)
{
    std::filesystem::create_directory(folder / gone);
    return run_renderer({"scene.xml", "--quiet", "--spp", "40000", "--crop", "20,16,4,4", "-o", output,
                         "--checkpoint", checkpoint, "--checkpoint-every", "0.05s"},
                        folder.path(), "",
                        once_there(folder / checkpoint, [&] { std::filesystem::remove_all(folder / gone); }));
}

} // namespace

TEST_CASE("a disk that is full leaves the last checkpoint", "[cli][faults]")
{
    const SceneFolder folder;
    REQUIRE(
        folder.run({"scene.xml", "-o", "a.exr", "--crop", "0,0,40,30", "--checkpoint", "c.exr"}).exit_code ==
        0);
    const std::string before = read_bytes(folder / "c.exr");
    const auto files = folder.files();
    // 4 kB: too little for either file.
    const RunResult full = run_limited(folder, "ulimit -f 4",
                                       {"scene.xml", "-o", "a.exr", "--crop", "0,0,40,30", "--checkpoint",
                                        "c.exr", "--resume", "--spp", "9", "--quiet"});
    CHECK(full.exit_code == 1);
    CHECK(full.err ==
          "error: cannot write 'c.exr': File too large and cannot write 'a.exr': File too large\n");
    CHECK(read_bytes(folder / "c.exr") == before);
    CHECK(folder.files() == files); // and nothing half-written
}

TEST_CASE("a checkpoint that cannot be written does not lose the picture", "[cli][faults]")
{
    const SceneFolder folder;
    REQUIRE(folder.run({"scene.xml", "-o", "whole.exr", "--quiet", "--spp", "40000", "--crop", "20,16,4,4"})
                .exit_code == 0);
    const RunResult result = lose_folder(folder, "gone", "a.exr", "gone/c.exr");
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.err,
               ContainsSubstring(
                   "warning: cannot write 'gone/c.exr': No such file or directory; rendering continues\n"));
    CHECK_THAT(result.err,
               ContainsSubstring("error: cannot write 'gone/c.exr': No such file or directory\n"));
    CHECK(read_bytes(folder / "a.exr") == read_bytes(folder / "whole.exr"));
}

TEST_CASE("a picture whose folder vanished is put beside the checkpoint", "[cli][faults]")
{
    const SceneFolder folder;
    std::filesystem::create_directory(folder / "kept");
    std::filesystem::create_directory(folder / "gone");
    const RunResult result = run_renderer(
        {"scene.xml", "--quiet", "--spp", "40000", "--crop", "20,16,4,4", "-o", "gone/a.exr", "--checkpoint",
         "kept/c.exr", "--checkpoint-every", "0.05s"},
        folder.path(), "",
        once_there(folder / "kept/c.exr", [&] { std::filesystem::remove_all(folder / "gone"); }));
    CHECK(result.exit_code == 1);
    CHECK(result.err == "error: cannot write 'gone/a.exr': the directory 'gone' does not exist; the image "
                        "was written to 'kept/a.exr' instead\n");
    REQUIRE(folder.run({"scene.xml", "-o", "whole.exr", "--quiet", "--spp", "40000", "--crop", "20,16,4,4"})
                .exit_code == 0);
    CHECK(read_bytes(folder / "kept/a.exr") == read_bytes(folder / "whole.exr"));
}

TEST_CASE("a scene that is edited while it is rendered is not gone on from", "[cli][faults]")
{
    const SceneFolder folder;
    REQUIRE(folder.run({"scene.xml", "-o", "whole.exr", "--quiet", "--spp", "40000", "--crop", "20,16,4,4"})
                .exit_code == 0);
    const Names words = {"scene.xml",          "--quiet", "--spp", "40000",        "--crop",
                         "20,16,4,4",          "-o",      "a.exr", "--checkpoint", "c.exr",
                         "--checkpoint-every", "0.05s"};
    const RunResult result =
        run_renderer(words, folder.path(), "", once_there(folder / "c.exr", [&] {
                         folder.write("scene.xml", small_scene(R"(<integrator type="path"/>)"));
                     }));
    // The picture is that of the scene as it was read.
    REQUIRE(result.exit_code == 0);
    CHECK(read_bytes(folder / "a.exr") == read_bytes(folder / "whole.exr"));
    Names more = words;
    more.emplace_back("--resume");
    const RunResult again = folder.run(more);
    CHECK(again.exit_code == 1);
    CHECK_THAT(again.err, ContainsSubstring("error: cannot resume from 'c.exr': 'scene.xml' has changed"));
}

// The address space that a sanitizer wants is not to be had in little memory.
#if !defined(__SANITIZE_ADDRESS__)
TEST_CASE("too little memory is an error wherever it is met", "[cli][faults]")
{
    const SceneFolder folder;
    int failures = 0;
    for (int megabytes = 500; megabytes <= 1200; megabytes += 100) {
        const RunResult result = run_limited(folder, "ulimit -v " + std::to_string(megabytes * 1000),
                                             {"scene.xml", "-o", "a.exr", "--size", "1500x1000", "--crop",
                                              "0,0,1500,10", "--spp", "1", "--quiet", "--threads", "1"});
        INFO(megabytes << " MB: " << result.err);
        REQUIRE((result.exit_code == 0 || result.exit_code == 1 ||
                 result.exit_code == 127)); // 127: not even loaded
        if (result.exit_code != 1) continue;
        ++failures;
        CHECK(result.err.find("memory") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(folder / "a.exr"));
    }
    CHECK(failures > 0);
}
#endif
