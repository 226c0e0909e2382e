// SPDX-License-Identifier: MIT

// Groups and their instances: loading, what the scene knows of them, memory.

#include "plumb/check/check.h"
#include "plumb/model/shape.h"
#include "plumb/render/aovs.h"
#include "plumb/render/render.h"
#include "plumb/scene/scene.h"
#include "support/catch.h"
#include "support/scene_text.h"

#include <fstream>

#include <fmt/format.h>

using namespace plumb;
using namespace plumb::test;

namespace {

std::string group(const std::string& id, const std::string& shapes)
{
    return "<shape type='group' id='" + id + "'>" + shapes + "</shape>";
}

std::string instance(const std::string& id, const std::string& operations)
{
    return "<shape type='instance'><ref id='" + id + "'/><transform name='toWorld'>" + operations +
           "</transform></shape>";
}

const std::string ball = "<shape type='sphere'><bsdf type='mirror'/></shape>";
const std::string disk = "<shape type='disk'><vector name='normal' value='0,0,1'/></shape>";

std::uint64_t resident_bytes()
{
    std::ifstream statm("/proc/self/statm");
    std::uint64_t pages = 0, resident = 0;
    statm >> pages >> resident;
    return resident * 4096;
}

// About 10,000 triangles.
std::string bumpy_ball()
{
    constexpr int n = 71;
    std::string text;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const double a = pi_d * i / n, b = 2.0 * pi_d * j / n,
                         r = 1.0 + 0.1 * std::sin(9 * a) * std::sin(7 * b);
            text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", r * std::sin(a) * std::cos(b),
                                r * std::sin(a) * std::sin(b), r * std::cos(a));
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int k = i * (n + 1) + j + 1;
            text += fmt::format("f {} {} {}\nf {} {} {}\n", k, k + 1, k + n + 1, k + 1, k + n + 2, k + n + 1);
        }
    return text;
}

} // namespace

TEST_CASE("a group is seen through its instances alone", "[unit][instance]")
{
    const LoadedScene loaded =
        load_text(start + instance("pair", "<translate value='0,0,5'/>") + group("pair", ball + disk) +
                  instance("pair", "<scale value='-2,1,1'/><translate value='9,0,5'/>") + "</scene>");
    const Scene& scene = *loaded.job.scene;
    CHECK(loaded.warnings.empty());
    CHECK(scene.objects().empty());
    REQUIRE(scene.instances().size() == 2);
    CHECK(scene.instances()[0].group == scene.instances()[1].group);
    CHECK(scene.instances()[0].name == "instance of 'pair' (scene.xml:1)");
    CHECK(scene.groups().size() == 1);
    CHECK(scene.bounds().min.x == Approx(-1.f));
    CHECK(scene.bounds().max.x == Approx(11.f));
    CHECK_FALSE(scene.intersect({Vec3f(0, 0, -5), Vec3f(0, 0, 1), 0.f, 8.f}));

    const auto first = scene.intersect({Vec3f(0, 0, -5), Vec3f(0, 0, 2)});
    REQUIRE(first);
    CHECK(first->position == Vec3f(0, 0, 4));
    CHECK(first->geometric_normal == Vec3f(0, 0, -1));
    CHECK(scene.instance_of(*first) == 0u);
    CHECK(scene.name_of(*first) == "shape 'sphere' (scene.xml:1) in instance of 'pair' (scene.xml:1)");
    // An ellipsoid: the mirror keeps its outside its front.
    const auto second = scene.intersect({Vec3f(20, 0, 5), Vec3f(-1, 0, 0)});
    REQUIRE(second);
    CHECK(second->position.x == Approx(11.f));
    CHECK(second->geometric_normal.x == Approx(1.f));
    CHECK(scene.instance_of(*second) == 1u);
    CHECK(scene.occluded({Vec3f(20, 0, 5), Vec3f(-1, 0, 0)}));
    CHECK_FALSE(scene.occluded({Vec3f(20, 3, 5), Vec3f(-1, 0, 0)}));
}

TEST_CASE("groups that nothing shows are warned of", "[unit][instance]")
{
    const LoadedScene loaded = load_text(start + group("lost", ball) + disk + "</scene>");
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0].message,
               ContainsSubstring("no <shape type=\"instance\"> names the group 'lost'"));
    CHECK_FALSE(loaded.job.scene->intersect({Vec3f(0, 0, 5), Vec3f(0, 0, -1), 0.f, 4.5f}));
}

TEST_CASE("BSDFs by reference serve groups", "[unit][instance]")
{
    const LoadedScene loaded =
        load_text(start + group("g", "<shape type='sphere'><ref id='gold'/></shape>") +
                  instance("g", "<scale value='2,1,1'/>") +
                  "<bsdf type='normalmap' id='gold'><bsdf type='diffuse'/></bsdf></scene>");
    const auto hit = loaded.job.scene->intersect({Vec3f(0.3f, 0.2f, 5), Vec3f(0, 0, -1)});
    REQUIRE(hit);
    // The frame of an oriented BSDF runs along dp/du, which the map stretches.
    const Vec3f along = tangents_at(*hit).dp_du;
    const Vec3f n = hit->shading.n;
    CHECK(length(hit->shading.s - normalize(along - n * dot(along, n))) < 1e-5f);
}

TEST_CASE("an instance is one object in the layer of ids", "[unit][instance][aov]")
{
    const LoadedScene loaded =
        load_text(start + group("g", ball + disk) + disk + instance("g", "<translate value='5,0,0'/>") +
                  instance("g", "<translate value='9,0,0'/>") + "</scene>");
    const Scene& scene = *loaded.job.scene;
    const AovView view(scene, *loaded.job.camera);
    const auto id_at = [&](float x) {
        const auto hit = scene.intersect({Vec3f(x, 0, 5), Vec3f(0, 0, -1)});
        REQUIRE(hit);
        return view.object_of(*hit);
    };
    CHECK(id_at(0) == 1);
    CHECK(id_at(5) == 2);
    CHECK(id_at(9) == 3);
    const std::vector<std::string> names{"object"};
    const auto tables = id_tables(names, scene);
    REQUIRE(tables.size() == 1);
    REQUIRE(tables[0].second.size() == 3);
    CHECK(tables[0].second[1] == "instance of 'g' (scene.xml:1)");
}

TEST_CASE("mistakes inside groups are found, and instances in one place", "[unit][instance][check]")
{
    const LoadedScene loaded =
        load_text("<scene dialect='plumb'><integrator type='path_mis'/>" + camera +
                  group("g", "<shape type='rectangle'><bsdf type='dielectric'/></shape>") +
                  "<emitter type='pointlight'><point name='position' value='0,0,-1'/></emitter>" +
                  instance("g", "<translate value='0,0,5'/>") + instance("g", "<translate value='0,0,5'/>") +
                  "</scene>");
    std::string all;
    for (const Doubt& doubt : find_doubts(loaded.job)) all += doubt.object + ": " + doubt.text + "\n";
    CHECK_THAT(all, ContainsSubstring("light enters its material, but the surface is not closed"));
    CHECK_THAT(all, ContainsSubstring("it is in the same place as instance of 'g'"));
}

TEST_CASE("maps that floats cannot hold are refused, and rays that Embree refuses meet nothing",
          "[unit][instance]")
{
    CHECK_FALSE(InstanceMap::from(*Transform::scale({1e10, 1, 1})));
    CHECK_FALSE(InstanceMap::from(*Transform::scale({1e-10, 1, 1})));
    CHECK(InstanceMap::from(*Transform::scale({1e-8, 1e8, -1})));
    const LoadedScene loaded =
        load_text(start + group("g", ball) + instance("g", "<scale value='1e-8,1e-8,1e-8'/>") + "</scene>");
    const Scene& scene = *loaded.job.scene;
    // In the space of the group its origin lies at 1e22.
    CHECK_FALSE(scene.intersect({Vec3f(1e14f, 0, 0), Vec3f(-1, 0, 0)}));
    CHECK_FALSE(scene.occluded({Vec3f(1e14f, 0, 0), Vec3f(-1, 0, 0)}));
    CHECK_FALSE(scene.occluded({Vec3f(1.f, 0, 0), Vec3f(-1e13f, 0, 0)}));
    CHECK(scene.intersect({Vec3f(1.f, 0, 0), Vec3f(-1, 0, 0)}));
}

TEST_CASE("a hundred thousand instances of ten thousand triangles take little memory", "[unit][instance]")
{
    const TempDirectory directory;
    directory.write("ball.obj", bumpy_ball());
    std::string text = start + "<shape type='group' id='g'><mesh type='obj'><string name='filename' "
                               "value='ball.obj'/></mesh></shape>";
    constexpr int side = 316;
    for (int i = 0; i < side * side + 144; ++i)
        text += instance("g", fmt::format("<translate value='{},{},9'/>", 3 * (i % side), 3 * (i / side)));
    const auto file = directory.write("scene.xml", text + "</scene>");
    text = std::string();
    const std::uint64_t before = resident_bytes();
    const LoadedScene loaded = load_scene(file);
    const Scene& scene = *loaded.job.scene;
    CHECK(scene.instances().size() == 100'000);
    CHECK(scene.triangle_count() == 9'940);
    CHECK(resident_bytes() - before < 1'000'000'000);
    CHECK(scene.memory().meshes + scene.memory().acceleration < 100'000'000);
    const auto hit = scene.intersect({Vec3f(300, 600, 0), Vec3f(0, 0, 1)});
    REQUIRE(hit);
    CHECK(scene.instance_of(*hit) == 200u * side + 100u);
}
