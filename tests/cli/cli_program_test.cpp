// SPDX-License-Identifier: MIT

// Checkpoints and parts are for one program, whatever its version number says.

#include "build_paths.h"
#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

namespace {

constexpr const char* library = "libplumb_images.so";

// The program and its library in a folder of their own; `changed` of the two, if any, is another build of the same version.
std::string copy_program(const TempFolder& folder, const std::string& changed)
{
    const std::filesystem::path program(PLUMB_RENDERER);
    for (const std::filesystem::path& file : {program, program.parent_path() / library}) {
        const std::filesystem::path copy = folder / file.filename();
        std::filesystem::copy_file(file, copy);
        if (file.filename() == changed) std::ofstream(copy, std::ios::app) << "changed";
    }
    return (folder / program.filename()).string();
}

RunResult run(const std::string& program, Names words, const SceneFolder& folder)
{
    words.insert(words.begin(), program);
    return run_program(words, folder.path());
}

} // namespace

TEST_CASE("a checkpoint is for one program", "[cli][checkpoint]")
{
    const SceneFolder folder;
    const TempFolder elsewhere;
    REQUIRE(folder.run({"scene.xml", "-o", "a.exr", "--checkpoint", "c.exr"}).exit_code == 0);
    const std::string before = read_bytes(folder / "c.exr");
    const Names more = {"scene.xml",    "-o",    "b.exr",    "--spp",  "9",
                        "--checkpoint", "c.exr", "--resume", "--quiet"};

    SECTION("which may lie anywhere")
    {
        CHECK(run(copy_program(elsewhere, ""), more, folder).exit_code == 0);
        CHECK(std::filesystem::exists(folder / "b.exr"));
    }
    SECTION("and be no other of the same version")
    {
        const std::string changed = GENERATE("renderer", "libplumb_images.so");
        const RunResult result = run(copy_program(elsewhere, changed), more, folder);
        CHECK(result.exit_code == 1);
        CHECK_THAT(result.err,
                   ContainsSubstring("error: cannot resume from 'c.exr': the hash of the program was "));
        CHECK(result.err.find(" and is ") != std::string::npos);
        CHECK(result.err.find("Plumb") == std::string::npos); // the version is the same
        CHECK(read_bytes(folder / "c.exr") == before);
        CHECK_FALSE(std::filesystem::exists(folder / "b.exr"));
    }
}

TEST_CASE("parts of two programs are not merged", "[cli][merge]")
{
    const SceneFolder folder;
    const TempFolder elsewhere;
    const bool same = GENERATE(true, false);
    const std::string other = copy_program(elsewhere, same ? "" : "renderer");
    REQUIRE(folder.run({"scene.xml", "--part", "1/2", "-o", "p1.exr"}).exit_code == 0);
    REQUIRE(run(other, {"scene.xml", "--part", "2/2", "-o", "p2.exr"}, folder).exit_code == 0);
    const RunResult result = folder.run({"merge", "p1.exr", "p2.exr", "-o", "a.exr"});
    CHECK(result.exit_code == (same ? 0 : 1));
    if (same) return;
    CHECK_THAT(result.err,
               ContainsSubstring(
                   "error: 'p1.exr' and 'p2.exr' are not parts of one image: the hash of the program was "));
    CHECK_FALSE(std::filesystem::exists(folder / "a.exr"));
}
