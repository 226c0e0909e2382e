// SPDX-License-Identifier: MIT

// A scene looks the same wherever it stands: the Cornell box and Veach's plates, moved so that each wall, plate and lamp in
// turn lies in a coordinate plane, by compare() with the power to see 1 %.

#include "plumb/compare/compare.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "plumb/scene_file/scene_file.h"
#include "support/catch.h"
#include "support/run.h"
#include "support/statistics.h"

#include <set>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

// The text with $move applied last to the camera and to every mesh.
std::string with_move(std::string text)
{
    const std::string move = "<translate value=\"$move\"/>";
    for (const std::string tag : {"camera", "mesh"}) {
        for (std::size_t at = 0; (at = text.find("<" + tag + " ", at)) != std::string::npos;) {
            const std::size_t end = text.find("</" + tag + ">", at);
            const std::size_t transform = text.find("</transform>", at);
            if (transform < end)
                text.insert(transform, move);
            else
                text.insert(end, "<transform name=\"toWorld\">" + move + "</transform>");
            at = text.find("</" + tag + ">", at);
        }
    }
    return text;
}

// A copy of our scenes in which what `parts` name can be moved by -D move=X,Y,Z.
class MovableScenes {
public:
    explicit MovableScenes(const std::vector<std::string>& parts)
    {
        std::filesystem::copy(PLUMB_SOURCE_DIR "/scenes", directory_.path(),
                              std::filesystem::copy_options::recursive);
        for (const std::string& part : parts)
            directory_.write(part, with_move(read_bytes(directory_ / part)));
    }

    std::filesystem::path file(const std::string& name) const { return directory_ / name; }

    Image render(const std::string& scene, const std::string& integrator, const Vec3d& move, int spp,
                 int seed) const
    {
        const RunResult run =
            run_renderer({scene, "-D", fmt::format("move={},{},{}", move.x, move.y, move.z), "-D",
                          "integrator=" + integrator, "--size", "64x48", "--spp", std::to_string(spp),
                          "--seed", std::to_string(seed), "-o", "out.exr"},
                         directory_.path());
        INFO(run.err);
        REQUIRE(run.exit_code == 0);
        return read_image(directory_ / "out.exr", false);
    }

private:
    TempDirectory directory_;
};

enum class Objects { all, emitters };

// For each axis, where surfaces of the objects are: the sides of their boxes, and the middle.
std::vector<Vec3d> moves_to_zero(const std::filesystem::path& scene_file, Objects which)
{
    RenderSettings options;
    options.scene.definitions["move"] = "0,0,0";
    const LoadedScene scene = load_scene(scene_file, options);
    std::set<double> places[3];
    for (const SceneObject& object : scene.job.scene->objects()) {
        if (which == Objects::emitters && !object.emitter) continue;
        const Box3f box = object.shape->bounds();
        for (int axis = 0; axis < 3; ++axis) {
            places[axis].insert(static_cast<double>(box.center()[axis]));
            if (which == Objects::all)
                for (const float place : {box.min[axis], box.max[axis]})
                    places[axis].insert(static_cast<double>(place));
        }
    }
    std::vector<Vec3d> moves;
    const std::size_t most = std::max({places[0].size(), places[1].size(), places[2].size()});
    for (std::size_t i = 0; i < most; ++i) {
        Vec3d move;
        for (int axis = 0; axis < 3; ++axis)
            move[axis] =
                -*std::next(places[axis].begin(), static_cast<std::ptrdiff_t>(i % places[axis].size()));
        moves.push_back(move);
    }
    return moves;
}

// power: a difference in all of the image that must be found.
void check_moves(const MovableScenes& scenes, const std::string& scene, const std::string& integrator,
                 Objects which, int spp, double power)
{
    const std::vector<Vec3d> moves = moves_to_zero(scenes.file(scene), which);
    REQUIRE(moves.size() >= 4);
    CompareSettings options;
    options.significance = sidak_level(significance, moves.size());
    options.flip = FlipMode::none;
    const Image reference = scenes.render(scene, integrator, Vec3d(0.0), 4 * spp, 1);
    int seed = 2;
    for (const Vec3d& move : moves) {
        const Comparison comparison =
            compare(scenes.render(scene, integrator, move, spp, seed++), reference, options);
        INFO(scene << ", " << integrator << ", moved by " << move.x << " " << move.y << " " << move.z
                   << ": p " << comparison.significance.p << ", " << comparison.significance.reason);
        // Single squares may be undecided for want of samples; the whole image is decided.
        CHECK(comparison.significance.verdict != Verdict::differs);
        REQUIRE(comparison.significance.detectable_bias);
        CHECK(*comparison.significance.detectable_bias < power);
    }
}

MovableScenes movable_box()
{
    return MovableScenes({"cbox/parts/room.xml", "cbox/parts/spheres_diffuse.xml"});
}

} // namespace

TEST_CASE("the Cornell box looks the same wherever it stands", "[statistical][shadow_ray]")
{
    check_moves(movable_box(), "cbox/cbox_mis.xml", "path_mis", Objects::all, 128, 0.01);
}

TEST_CASE("the Cornell box by light sampling looks the same wherever it stands",
          "[statistical][shadow_ray][slow]")
{
    check_moves(movable_box(), "cbox/cbox_mis.xml", "path_nee", Objects::all, 640, 0.01);
}

TEST_CASE("Veach's plates look the same wherever they stand", "[statistical][shadow_ray]")
{
    check_moves(MovableScenes({"veach_mi/parts/plates.xml"}), "veach_mi/veach_mis.xml", "path_mis",
                Objects::emitters, 160, 0.05);
}

TEST_CASE("Veach's plates look the same to a percent wherever they stand", "[statistical][shadow_ray][slow]")
{
    check_moves(MovableScenes({"veach_mi/parts/plates.xml"}), "veach_mi/veach_mis.xml", "path_mis",
                Objects::emitters, 12000, 0.01);
    check_moves(MovableScenes({"veach_mi/parts/plates.xml"}), "veach_mi/veach_mis.xml", "path_mis",
                Objects::all, 640, 0.05);
}
