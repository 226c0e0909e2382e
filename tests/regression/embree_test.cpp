// SPDX-License-Identifier: MIT

// Whether Embree builds trees that give the same hits, whatever the threads.

#include "base/parallel.h"
#include "plumb/model/shape.h"
#include "plumb/scene/scene.h"
#include "support/catch.h"
#include "support/params.h"
#include "support/random.h"
#include "support/temp_directory.h"

#include <bit>
#include <optional>

namespace plumb {
class Diffuse;
class ObjMesh;
} // namespace plumb

using namespace plumb;
using test::ParamsBuilder;
using test::TestRandom;

namespace {

// Triangles of many sizes all over the unit cube: a lot of overlap, and hits that are close together.
std::string soup(int triangles)
{
    TestRandom random(4);
    std::string text;
    for (int i = 0; i < triangles; ++i) {
        const double size = std::exp(random.between(-7.0, -2.5));
        const double center[3] = {random.next_double(), random.next_double(), random.next_double()};
        for (int corner = 0; corner < 3; ++corner) {
            text += "v";
            for (const double x : center) text += " " + std::to_string(x + size * random.between(-1.0, 1.0));
            text += "\n";
        }
    }
    for (int i = 0; i < triangles; ++i)
        text += "f " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + " " +
                std::to_string(3 * i + 3) + "\n";
    return text;
}

// A number that depends on every bit of all hits.
std::uint64_t hits_of(const Scene& scene, int rays)
{
    TestRandom random(9);
    std::uint64_t hash = 1;
    for (int i = 0; i < rays; ++i) {
        const Vec3f origin(random.next_1d(), random.next_1d(), random.next_1d());
        const Vec3f target(random.next_1d(), random.next_1d(), random.next_1d());
        const auto hit = scene.intersect({origin, normalize(target - origin)});
        const Vec3f p = hit ? hit->position : Vec3f(-1.f);
        for (const float x : {p.x, p.y, p.z})
            hash = (hash ^ std::bit_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15u;
    }
    return hash;
}

} // namespace

TEST_CASE("trees built by any number of threads give the same hits", "[regression][determinism][slow]")
{
    const TempDirectory directory;
    const std::string file = directory.write("soup.obj", soup(500000)).string();
    std::optional<std::uint64_t> first;
    for (const int threads : {1, 2, 4}) {
        for (int round = 0; round < 5; ++round) {
            std::optional<Scene> scene;
            parallel_for(1, threads, [&](std::size_t) { // the build takes the threads of this arena
                std::vector<SceneObject> objects;
                objects.push_back(
                    {ParamsBuilder("mesh", "obj").string("filename", file).build<ObjMesh, Shape>(),
                     ParamsBuilder("bsdf", "diffuse").build<Diffuse, Bsdf>(), nullptr, "soup"});
                scene.emplace(std::move(objects), std::vector<std::unique_ptr<Emitter>>());
            });
            const std::uint64_t hits = hits_of(*scene, 1000000);
            if (!first) first = hits;
            CHECK(hits == *first);
        }
    }
    CHECK(first != 1);
}
