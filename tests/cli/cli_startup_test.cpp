// SPDX-License-Identifier: MIT

// The program starts fast, because it loads OpenImageIO only for pictures.

#include "build_paths.h"
#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

namespace {

// Whether a run loads OpenImageIO, by what the loader of libraries says.
bool loads_images(const SceneFolder& folder, const Names& words)
{
    const RunResult result = run_renderer(words, folder.path(), "", {}, {"LD_DEBUG=files"});
    REQUIRE(result.err.find("libembree") != std::string::npos);
    return result.err.find("libOpenImageIO") != std::string::npos;
}

// A program without its libplumb_images.so.
std::string lone_renderer(const SceneFolder& folder)
{
    std::filesystem::create_directories(folder / "bin");
    std::filesystem::copy_file(PLUMB_RENDERER, folder / "bin/renderer");
    return (folder / "bin/renderer").string();
}

const std::string missing =
    "error: cannot read or write images: libplumb_images.so, a part of Plumb, is neither in '";

} // namespace

TEST_CASE("only pictures take OpenImageIO", "[cli][startup]")
{
    const SceneFolder folder;
    CHECK_FALSE(loads_images(folder, {"--version"}));
    CHECK_FALSE(loads_images(folder, {"--help"}));
    CHECK_FALSE(loads_images(folder, {"types"}));
    CHECK_FALSE(loads_images(folder, {"--no-such-option"}));
    folder.write("wrong.xml", small_scene(R"(<integrator type="path_mis" depht="3"/>)"));
    CHECK_FALSE(loads_images(folder, {"wrong.xml", "-o", "a.exr"}));
    CHECK(loads_images(folder, {"scene.xml", "-o", "a.exr"}));
}

TEST_CASE("a program without libplumb_images.so says so, before it has rendered for hours", "[cli][startup]")
{
    const SceneFolder folder;
    const std::string program = lone_renderer(folder);
    const auto before = folder.files();
    const RunResult result =
        run_program({program, "scene.xml", "-o", "a.exr", "--quiet", "--spp", "50000000"}, folder.path());
    CHECK(result.exit_code == 1);
    CHECK(result.err == missing + (folder / "bin").string() + "', '" + (folder / "lib/plumb").string() +
                            "' nor in the library path\n");
    CHECK(folder.files() == before);
    CHECK(run_program({program, "types"}, folder.path()).exit_code == 0);
}

TEST_CASE("libplumb_images.so is found beside the program, where it is installed and in the library path",
          "[cli][startup]")
{
    const SceneFolder folder;
    const std::string program = lone_renderer(folder);
    const std::filesystem::path module =
        std::filesystem::path(PLUMB_RENDERER).parent_path() / "libplumb_images.so";
    const Names words = {program, "scene.xml", "-o", "a.exr", "--quiet"};
    SECTION("beside the program")
    {
        std::filesystem::copy_file(module, folder / "bin/libplumb_images.so");
        CHECK(run_program(words, folder.path()).err.empty());
    }
    SECTION("where it is installed")
    {
        std::filesystem::create_directories(folder / "lib/plumb");
        std::filesystem::copy_file(module, folder / "lib/plumb/libplumb_images.so");
        CHECK(run_program(words, folder.path()).err.empty());
    }
    SECTION("in the library path")
    {
        const std::string path = "LD_LIBRARY_PATH=" + module.parent_path().string();
        CHECK(run_program(words, folder.path(), "", {}, {path}).err.empty());
    }
    SECTION("a broken one is not taken")
    {
        folder.write("bin/libplumb_images.so", "no library");
        const RunResult result = run_program(words, folder.path());
        CHECK(result.exit_code == 1);
        CHECK(result.err == "error: cannot read or write images: " +
                                (folder / "bin/libplumb_images.so").string() + ": file too short\n");
    }
}
