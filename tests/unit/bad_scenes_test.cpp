// SPDX-License-Identifier: MIT
// Every file in tests/scenes/bad beside the exact text of what is wrong with it.

#include "plumb/scene_file.h"
#include "support/catch.h"

#include <fstream>
#include <iterator>

using namespace plumb;

namespace {

const std::filesystem::path folder = std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "bad";

std::vector<std::filesystem::path> bad_scenes()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".xml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string read(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// What loading complains of, with paths relative to the folder.
std::string complaints(const std::filesystem::path& path)
{
    std::string text;
    try {
        load_scene(path);
        return "no error\n";
    } catch (const SceneError& error) {
        text = error.what();
    } catch (const Error& error) {
        text = std::string("not a scene error: ") + error.what();
    }
    const std::string prefix = folder.string() + "/";
    for (std::size_t i = text.find(prefix); i != text.npos; i = text.find(prefix, i))
        text.erase(i, prefix.size());
    return text + "\n";
}

} // namespace

TEST_CASE("bad scenes", "[unit][bad_scenes]")
{
    const std::filesystem::path path = GENERATE(from_range(bad_scenes()));
    CAPTURE(path.filename());
    const auto expected = std::filesystem::path(path).replace_extension(".expected");
    CHECK(complaints(path) == read(expected));
}

TEST_CASE("there are bad scenes", "[unit][bad_scenes]")
{
    CHECK(bad_scenes().size() >= 60);
}
