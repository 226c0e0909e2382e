// SPDX-License-Identifier: MIT

// The program starts fast, because it loads what reads and writes images only for images.

#include "build_paths.h"
#include "cli/small_scene.h"
#include "support/catch.h"

using namespace plumb;

namespace {

// Whether a run loads the image library, by what the loader of libraries says.
bool loads_images(const SceneDirectory& directory, const Names& words)
{
    const RunResult result = run_renderer(words, directory.path(), "", {}, {"LD_DEBUG=files"});
    REQUIRE(result.err.find("libembree") != std::string::npos);
    return result.err.find("libplumb_images") != std::string::npos;
}

// A program without its libplumb_images.so.
std::string lone_renderer(const SceneDirectory& directory)
{
    std::filesystem::create_directories(directory / "bin");
    std::filesystem::copy_file(PLUMB_RENDERER, directory / "bin/renderer");
    return (directory / "bin/renderer").string();
}

const std::string missing =
    "error: cannot read or write images: libplumb_images.so, a part of Plumb, is neither in '";

} // namespace

TEST_CASE("only images take the image library", "[cli][startup]")
{
    const SceneDirectory directory;
    CHECK_FALSE(loads_images(directory, {"--version"}));
    CHECK_FALSE(loads_images(directory, {"--help"}));
    CHECK_FALSE(loads_images(directory, {"types"}));
    CHECK_FALSE(loads_images(directory, {"--no-such-option"}));
    directory.write("wrong.xml", small_scene(R"(<integrator type="path_mis" depht="3"/>)"));
    CHECK_FALSE(loads_images(directory, {"wrong.xml", "-o", "a.exr"}));
    CHECK(loads_images(directory, {"scene.xml", "-o", "a.exr"}));
}

TEST_CASE("a program without libplumb_images.so says so, before it has rendered for hours", "[cli][startup]")
{
    const SceneDirectory directory;
    const std::string program = lone_renderer(directory);
    const auto before = directory.files();
    const RunResult result =
        run_program({program, "scene.xml", "-o", "a.exr", "--quiet", "--spp", "50000000"}, directory.path());
    CHECK(result.exit_code == 1);
    CHECK(result.err == missing + (directory / "bin").string() + "', '" + (directory / "lib/plumb").string() +
                            "' nor in the library path\n");
    CHECK(directory.files() == before);
    CHECK(run_program({program, "types"}, directory.path()).exit_code == 0);
}

TEST_CASE("libplumb_images.so is found beside the program, where it is installed and in the library path",
          "[cli][startup]")
{
    const SceneDirectory directory;
    const std::string program = lone_renderer(directory);
    const std::filesystem::path module =
        std::filesystem::path(PLUMB_RENDERER).parent_path() / "libplumb_images.so";
    const Names words = {program, "scene.xml", "-o", "a.exr", "--quiet"};
    SECTION("beside the program")
    {
        std::filesystem::copy_file(module, directory / "bin/libplumb_images.so");
        CHECK(run_program(words, directory.path()).err.empty());
    }
    SECTION("where it is installed")
    {
        std::filesystem::create_directories(directory / "lib/plumb");
        std::filesystem::copy_file(module, directory / "lib/plumb/libplumb_images.so");
        CHECK(run_program(words, directory.path()).err.empty());
    }
    SECTION("in the library path")
    {
        const std::string path = "LD_LIBRARY_PATH=" + module.parent_path().string();
        CHECK(run_program(words, directory.path(), "", {}, {path}).err.empty());
    }
    SECTION("a broken one is not taken")
    {
        directory.write("bin/libplumb_images.so", "no library");
        const RunResult result = run_program(words, directory.path());
        CHECK(result.exit_code == 1);
        CHECK(result.err == "error: cannot read or write images: " +
                                (directory / "bin/libplumb_images.so").string() + ": file too short\n");
    }
}
