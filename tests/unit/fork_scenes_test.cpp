// SPDX-License-Identifier: MIT

// Scenes in the words of forks of Nori (tests/scenes/forks): they load, and look as they did when somebody looked at them.

#include "build_paths.h"
#include "plumb/image/image.h"
#include "plumb/render/render.h"
#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"
#include "support/temp_directory.h"

#include <fstream>
#include <map>
#include <sstream>

using namespace plumb;

namespace {

const std::filesystem::path directory =
    std::filesystem::path(PLUMB_SOURCE_DIR) / "tests" / "scenes" / "forks";

// The mean colours of the left and the right half of an image.
struct Halves {
    Vec3d left{0.0}, right{0.0};
};

Halves halves_of(const Image& image)
{
    Halves sum;
    const PixelRect& data = image.data_window();
    for (int y = 0; y < data.height; ++y)
        for (int x = 0; x < data.width; ++x) {
            const Color color = image.color(x, y);
            Vec3d& half = 2 * x < data.width ? sum.left : sum.right;
            half += Vec3d(static_cast<double>(color.r), static_cast<double>(color.g),
                          static_cast<double>(color.b));
        }
    const double pixels = 0.5 * data.width * data.height;
    return {sum.left / pixels, sum.right / pixels};
}

std::map<std::string, Halves> expected()
{
    std::ifstream file(directory / "means.txt");
    std::map<std::string, Halves> means;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        std::string name;
        Halves halves;
        words >> name >> halves.left.x >> halves.left.y >> halves.left.z >> halves.right.x >>
            halves.right.y >> halves.right.z;
        means.emplace(std::move(name), halves);
    }
    return means;
}

} // namespace

TEST_CASE("scenes of forks load, and look as they should", "[statistical][forks]")
{
    const std::map<std::string, Halves> means = expected();
    const std::vector<std::filesystem::path> scenes = xml_files(directory);
    CHECK(scenes.size() == means.size());
    for (const std::filesystem::path& path : scenes) {
        const std::string name = path.stem().string();
        CAPTURE(name);
        RenderSettings settings;
        settings.scene.lenient = name.starts_with("lenient");
        const LoadedScene scene = load_scene(path, settings);
        RenderOptions options;
        options.samples_per_pixel = 64;
        const Halves found = halves_of(render(scene.job, options).film.develop());
        const auto wanted = means.find(name);
        REQUIRE(wanted != means.end());
        for (int i = 0; i < 3; ++i) {
            CHECK(found.left[i] == Approx(wanted->second.left[i]).epsilon(0.1).margin(0.01));
            CHECK(found.right[i] == Approx(wanted->second.right[i]).epsilon(0.1).margin(0.01));
        }
    }
}
