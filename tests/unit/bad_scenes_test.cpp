// SPDX-License-Identifier: MIT
// Every file in tests/scenes/bad beside the exact text of what is wrong with it.

#include "build_paths.h"
#include "plumb/scene_file/scene_file.h"
#include "support/bad_files.h"

using namespace plumb;

namespace {

const std::filesystem::path directory = std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "bad";

} // namespace

TEST_CASE("bad scenes", "[unit][bad_scenes]")
{
    const std::filesystem::path path = GENERATE(from_range(xml_files(directory)));
    check_complaints(path, [](const std::filesystem::path& scene) { load_scene(scene); });
}

TEST_CASE("there are bad scenes", "[unit][bad_scenes]")
{
    CHECK(xml_files(directory).size() >= 60);
}
