// SPDX-License-Identifier: MIT

// Surfaces that lie in each other are found wherever they are, and neighbours are not taken for them.

#include "build_paths.h"
#include "check/coincidence.h"
#include "check/triangle_overlap.h"
#include "plumb/check/check.h"
#include "support/catch.h"
#include "support/random.h"
#include "support/scene_text.h"

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

struct Placement {
    Frame frame;
    Vec3f origin;
    // x and y in a plane, z off it.
    Vec3f at(double x, double y, double z = 0.0) const
    {
        return frame.to_world(Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z))) +
               origin;
    }
};

// Axis-aligned for a third of them, as scenes made by hand are.
Placement placement(TestRandom& random)
{
    const double scale = std::pow(10.0, random.between(-2.0, 3.0));
    const auto number = [&] { return static_cast<float>(random.between(-scale, scale)); };
    const Vec3f origin(number(), number(), number());
    const Vec3f axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::size_t axis = random.next_bits() % 9;
    return {Frame(axis < 3 ? axes[axis] : random.direction()), origin};
}

std::string line(const Vec3f& p)
{
    return fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
}

// The cells of a rectangle [x0, x1] x [y0, y1], n by n, two triangles each.
std::string sheet(const Placement& place, double x0, double y0, double x1, double y1, double z, int n,
                  bool turned = false)
{
    std::string obj;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) obj += line(place.at(x0 + (x1 - x0) * i / n, y0 + (y1 - y0) * j / n, z));
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i + 1, b = a + 1, c = b + n + 1, d = a + n + 1;
            obj += turned ? fmt::format("f {} {} {} {}\n", d, c, b, a)
                          : fmt::format("f {} {} {} {}\n", a, b, c, d);
        }
    }
    return obj;
}

LoadedScene load(const std::string& first, const std::string& second, const std::string& more_of_first = "",
                 const std::string& more_of_second = "")
{
    const TempDirectory directory;
    directory.write("a.obj", first);
    directory.write("b.obj", second);
    const auto mesh = [](const std::string& file, const std::string& more) {
        return "<mesh type='obj'><string name='filename' value='" + file + "'/>" + more + "</mesh>";
    };
    return load_scene(directory.write("s.xml", start + "\n" + mesh("a.obj", more_of_first) + "\n" +
                                                   mesh("b.obj", more_of_second) + "</scene>"));
}

Coincidences coincidences(const std::string& first, const std::string& second)
{
    return find_coincidences(load(first, second).job.scene->objects());
}

std::string texts(const LoadedScene& scene)
{
    std::string text;
    for (const Doubt& doubt : find_doubts(scene.job)) text += doubt.object + ": " + doubt.text + "\n";
    return text;
}

const std::string glass = "<bsdf type='dielectric'/>";
const std::string lamp = "<emitter type='area'/>";

} // namespace

TEST_CASE("sheets that lie in each other are found wherever they are", "[unit][coincidence]")
{
    TestRandom random(11);
    for (int i = 0; i < 150; ++i) {
        const Placement place = placement(random);
        const double x = random.between(-1.4, 0.9), y = random.between(-1.4, 0.9),
                     size = random.between(0.5, 2.0);
        const bool turned = (random.next_bits() & 1) != 0;
        const int n = 1 + static_cast<int>(random.next_bits() % 5);
        CAPTURE(i, x, y, size, turned, n, place.origin.x, place.origin.y, place.origin.z);
        const Coincidences result = coincidences(sheet(place, -1, -1, 1, 1, 0, n),
                                                 sheet(place, x, y, x + size, y + size, 0, 3, turned));
        CHECK(result.is_complete);
        REQUIRE(result.found.size() == 1);
        CHECK(result.found[0].first == 0);
        CHECK(result.found[0].second == 1);
        CHECK(result.found[0].faces_alike == !turned);
        CHECK_FALSE(result.found[0].places.empty());
        // A gap of 16 times what counts as one surface, which is what check says to leave, is enough.
        const double gap = 16.0 * result.found[0].tolerance;
        CHECK(coincidences(sheet(place, -1, -1, 1, 1, 0, n),
                           sheet(place, x, y, x + size, y + size, gap, 3, turned))
                  .found.empty());
    }
}

TEST_CASE("neighbours in a plane, and walls that meet, do not coincide", "[unit][coincidence]")
{
    TestRandom random(12);
    for (int i = 0; i < 100; ++i) {
        const Placement place = placement(random);
        const int n = 1 + static_cast<int>(random.next_bits() % 6),
                  m = 1 + static_cast<int>(random.next_bits() % 6);
        CAPTURE(i, n, m, place.origin.x, place.origin.y, place.origin.z);
        // Beside each other in one plane, with other corners along the border; around a corner; through each other.
        const std::string floor = sheet(place, -1, -1, 1, 1, 0, n);
        CHECK(coincidences(floor, sheet(place, 1, -1.3, 3, 1, 0, m)).found.empty());
        const Placement upright{Frame(place.frame.to_world(Vec3f(1, 0, 0))), place.at(1, 0)};
        const Placement through{upright.frame, place.at(0.3, 0.1)};
        CHECK(coincidences(floor, sheet(upright, -1, -1, 1, 1, 0, m)).found.empty());
        CHECK(coincidences(floor, sheet(through, -1, -1, 1, 1, 0, m)).found.empty());
    }
}

TEST_CASE("a curved surface does not coincide with itself, however fine", "[unit][coincidence]")
{
    std::string obj;
    constexpr int n = 120; // along and around; facets are a thousandth of a radian apart near the poles
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i < n; ++i) {
            const double theta = pi_d * j / n, phi = 2.0 * pi_d * i / n;
            obj += fmt::format("v {:.8g} {:.8g} {:.8g}\n", 7 + std::sin(theta) * std::cos(phi),
                               std::cos(theta), std::sin(theta) * std::sin(phi) - 20);
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            obj += fmt::format("f {} {} {} {}\n", j * n + i + 1, j * n + (i + 1) % n + 1,
                               (j + 1) * n + (i + 1) % n + 1, (j + 1) * n + i + 1);
    const Placement far{Frame(Vec3f(0, 0, 1)), Vec3f(0, 0, 50)};
    CHECK(coincidences(obj, sheet(far, -1, -1, 1, 1, 0, 1)).found.empty());
    // The same mesh twice: all of it.
    const Coincidences twice = coincidences(obj, obj);
    REQUIRE(twice.found.size() == 1);
    CHECK(twice.found[0].faces_alike);
    CHECK(twice.found[0].count >= 2 * n * (n - 2));
}

TEST_CASE("equal spheres coincide, and others do not", "[unit][coincidence]")
{
    const auto sphere = [](const std::string& center, const std::string& radius) {
        return "<mesh type='sphere'><point name='center' value='" + center +
               "'/><float name='radius' value='" + radius + "'/></mesh>";
    };
    const auto found = [&](const std::string& a, const std::string& b) {
        return find_coincidences(
                   load_text(start + a + sphere("9,9,9", "0.5") + b + "</scene>").job.scene->objects())
            .found;
    };
    const auto equal = found(sphere("1,2,3", "0.7"), sphere("1,2,3", "0.7"));
    REQUIRE(equal.size() == 1);
    CHECK((equal[0].first == 0 && equal[0].second == 2));
    CHECK(found(sphere("1,2,3", "0.7"), sphere("1,2,3", "0.71")).empty());
    CHECK(found(sphere("1,2,3", "0.7"), sphere("1,2.001,3", "0.7")).empty());
    CHECK(found(sphere("1,2,3", "0.7"), sphere("2.4,2,3", "0.7")).empty()); // they touch
}

TEST_CASE("a plane through a million triangles is no reason to give up", "[unit][coincidence][slow]")
{
    TestRandom random(13);
    const Placement tilted{Frame(normalize(Vec3f(1, 2, 3))), Vec3f(0.1f)};
    std::string dust;
    for (int i = 0; i < 300000; ++i) {
        const Vec3f p(random.next_1d() - 0.5f, random.next_1d() - 0.5f, random.next_1d() - 0.5f);
        dust += line(p) + line(p + 0.002f * random.direction()) + line(p + 0.002f * random.direction()) +
                "f -3 -2 -1\n";
    }
    const Coincidences result = coincidences(sheet(tilted, -9, -9, 9, 9, 0, 1), dust);
    CHECK(result.is_complete);
    CHECK(result.found.empty());
}

TEST_CASE("check names surfaces that coincide, and what comes of it", "[unit][coincidence]")
{
    const Placement flat{Frame(Vec3f(0, 0, 1)), Vec3f(0, 0, 5)};
    const std::string floor = sheet(flat, -1, -1, 1, 1, 0, 1), tile = sheet(flat, -0.5, -0.5, 0.5, 0.5, 0, 1),
                      turned = sheet(flat, -0.5, -0.5, 0.5, 0.5, 0, 1, true);
    CHECK_THAT(texts(load(floor, tile, "", glass)),
               ContainsSubstring("mesh 'obj' (s.xml:3): it coincides with mesh 'obj' (s.xml:2) around (") &&
                   ContainsSubstring("): paths miss one of the two surfaces, so light takes wrong paths; "
                                     "leave a gap of at least 0.0002, or let them intersect\n"));
    CHECK_THAT(texts(load(floor, tile, "", lamp)),
               ContainsSubstring("mesh 'obj' (s.xml:3): it coincides with mesh 'obj' (s.xml:2) around (") &&
                   ContainsSubstring(
                       "): where rays hit the other surface the emitter is dark, yet it is sampled there, so "
                       "integrators disagree; move the emitter at least 0.0002 to its front\n"));
    CHECK_THAT(
        texts(load(floor, tile, lamp, lamp)),
        ContainsSubstring("mesh 'obj' (s.xml:2): it coincides with mesh 'obj' (s.xml:3) around (") &&
            ContainsSubstring("): rays hit only one of two emitters in one place, but both are sampled, so "
                              "integrators disagree; remove one, or leave a gap of at least 0.0002\n"));
    CHECK_THAT(texts(load(floor, tile)),
               ContainsSubstring("): rays hit either of them by chance, which is visible if their BSDFs "
                                 "differ; remove one, or leave a gap of at least 0.0002\n"));
    CHECK_THAT(texts(load(floor, turned)),
               ContainsSubstring("): rays hit the front of one or the black back of the other by chance; "
                                 "leave a gap of at least 0.0002\n"));
    CHECK_THAT(texts(load(floor + tile, "v 9 9 9\nv 8 9 9\nv 9 8 9\nf 1 2 3\n")),
               ContainsSubstring("mesh 'obj' (s.xml:2): parts of it coincide around (") &&
                   ContainsSubstring("): rays hit either of them by chance, which is visible if their "
                                     "normals or texture coordinates differ\n"));
}

TEST_CASE("an opaque box that stands on a floor is no doubt", "[unit][coincidence]")
{
    // Its bottom is where the floor is, and is seen from nowhere but its inside.
    const std::string box = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
                            "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    const std::string floor = "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 4 3 2 1\n";
    const auto doubts = [&](const std::string& more, const std::string& obj) {
        const std::string all = texts(load(floor, obj, "", more));
        return all.find("coincide") != all.npos;
    };
    REQUIRE(coincidences(floor, box).found.size() == 1);
    CHECK_FALSE(doubts("", box));
    CHECK(doubts(glass, box));
    CHECK(
        doubts("", box.substr(0, box.rfind("f 8 7 6 5")) + box.substr(box.rfind("f 1 5")))); // without a lid
}

TEST_CASE("the scenes that come with us leave no doubt about coincident surfaces or distance",
          "[unit][coincidence]")
{
    for (const char* directory : {"scenes", "tests/scenes/independent"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(
                 std::filesystem::path(PLUMB_SOURCE_DIR) / directory)) {
            // parts/ has what other scenes include.
            if (entry.path().extension() != ".xml" || entry.path().parent_path().filename() == "parts")
                continue;
            const std::string text = read_bytes(entry.path());
            if (text.find("<suite") != text.npos || text.find("<test") != text.npos) continue;
            CAPTURE(entry.path());
            const LoadedScene scene = load_scene(entry.path());
            CHECK(find_coincidences(scene.job.scene->objects()).is_complete);
            for (const Doubt& doubt : find_doubts(scene.job))
                CHECK_THAT(doubt.text, !ContainsSubstring("32-bit floats") && !ContainsSubstring("coincide"));
        }
    }
}
