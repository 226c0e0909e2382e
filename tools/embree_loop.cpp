// SPDX-License-Identifier: MIT

// The bare Embree loop that tools/bench holds the renderer against: the least program that traces the same kind of
// paths through the same triangles with the same Embree settings.
//
//     embree_loop SCENE.xml [--threads N] [--spp N]
//
// Diffuse surfaces of one albedo, next-event estimation towards the scene's lamps at every vertex, cosine-weighted
// bounces, Russian roulette from the third bounce: one bounce ray and one shadow ray a vertex, like path_mis. No
// materials, textures, virtual calls, error bounds or exact film; hit points come from Embree's t with a fixed epsilon,
// random numbers from a 64-bit generator. The scene's triangles are read through the library; its spheres are left out.
// Prints one line of JSON.

#include "base/float_mode.h"
#include "plumb/model/shape.h"
#include "plumb/scene/instruction_set.h"
#include "plumb/scene/scene.h"
#include "plumb/scene_file/scene_file.h"
#include "scene/accel_rays.h"

#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace plumb;

constexpr float albedo = 0.6f;
constexpr float epsilon = 1e-4f;

struct Lamp {
    Vec3f corner, edge1, edge2, normal;
    float area;
};

struct Triangles final : AccelBuilder {
    std::vector<Vec3f> positions;
    std::vector<Triangle> indices;
    std::vector<Lamp> lamps;
    bool is_lamp = false;

    void add_triangles(std::span<const Vec3f> p, std::span<const Triangle> t) override
    {
        const auto first = static_cast<std::uint32_t>(positions.size());
        positions.insert(positions.end(), p.begin(), p.end());
        for (const Triangle& triangle : t) {
            indices.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
            const Vec3f edge1 = p[triangle[1]] - p[triangle[0]];
            const Vec3f edge2 = p[triangle[2]] - p[triangle[0]];
            const Vec3f normal = cross(edge1, edge2);
            if (is_lamp)
                lamps.push_back({p[triangle[0]], edge1, edge2, normalize(normal), 0.5f * length(normal)});
        }
    }
    void add_user(const Primitives&) override {}
};

// PCG's multiplier and an output permutation of the high bits.
struct Random {
    std::uint64_t state;
    float next()
    {
        state = state * 6364136223846793005u + 1442695040888963407u;
        std::uint64_t x = state;
        x = (x ^ (x >> 22)) >> (22 + (x >> 61));
        return static_cast<float>((x & 0xffffffu)) * 0x1p-24f;
    }
};

struct Loop {
    RTCScene scene;
    const std::vector<Lamp>& lamps;
    const Camera& camera;
    Vec2i size;
    int samples;
    std::atomic<int> next_row = 0;
    std::atomic<std::uint64_t> rays = 0;
    std::atomic<float> sum = 0.f; // so that no work can be optimised away

    RTCRayHit trace(const Vec3f& origin, const Vec3f& direction) const
    {
        return intersect_scene(scene, {origin.x, origin.y, origin.z, epsilon, direction.x, direction.y,
                                       direction.z, 0.f, infinity, ~0u, 0, 0});
    }

    bool occluded(const Vec3f& origin, const Vec3f& direction) const
    {
        return is_occluded(scene, {origin.x, origin.y, origin.z, epsilon, direction.x, direction.y,
                                   direction.z, 0.f, 1.f - epsilon, ~0u, 0, 0});
    }

    float path(Vec3f origin, Vec3f direction, Random& random, std::uint64_t& count) const
    {
        float result = 0.f;
        float throughput = 1.f;
        for (int depth = 0;; ++depth) {
            const RTCRayHit hit = trace(origin, direction);
            ++count;
            if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
            Vec3f normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
            normal *= 1.f / std::sqrt(dot(normal, normal));
            if (dot(normal, direction) > 0.f) normal = -normal;
            origin += direction * hit.ray.tfar;

            const auto choice = static_cast<std::size_t>(random.next() * static_cast<float>(lamps.size()));
            const Lamp& lamp = lamps[choice];
            const float root = std::sqrt(random.next());
            const float b = random.next();
            const Vec3f to_lamp = lamp.corner + lamp.edge1 * (1.f - root) + lamp.edge2 * (b * root) - origin;
            const float cos_here = dot(normal, to_lamp);
            const float cos_there = -dot(lamp.normal, to_lamp);
            if (cos_here > 0.f && cos_there > 0.f) {
                ++count;
                const float d2 = dot(to_lamp, to_lamp);
                if (!occluded(origin, to_lamp))
                    result += throughput * albedo * inv_pi * cos_here * cos_there / (d2 * d2) * lamp.area *
                              static_cast<float>(lamps.size());
            }

            throughput *= albedo;
            if (depth >= 3) {
                const float survival = std::min(throughput, 0.95f);
                if (random.next() >= survival) break;
                throughput /= survival;
            }
            const float r = std::sqrt(random.next());
            const float phi = two_pi * random.next();
            direction =
                Frame(normal).to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1.f - r * r)});
        }
        return result;
    }

    void work()
    {
        const FlushDenormals flush;
        std::uint64_t count = 0;
        float total = 0.f;
        for (int y = next_row++; y < size.y; y = next_row++) {
            Random random{static_cast<std::uint64_t>(y) * 0x9e3779b97f4a7c15u + 1};
            for (int x = 0; x < size.x; ++x)
                for (int s = 0; s < samples; ++s) {
                    const float jitter_x = random.next();
                    const float jitter_y = random.next();
                    const Ray ray =
                        camera
                            .sample_ray({static_cast<float>(x) + jitter_x, static_cast<float>(y) + jitter_y},
                                        {0.5f, 0.5f})
                            .ray;
                    total += path(ray.origin, ray.direction, random, count);
                }
        }
        rays += count;
        sum.store(sum.load() + total);
    }
};

int run(int argc, char** argv)
{
    int threads = static_cast<int>(std::thread::hardware_concurrency());
    int samples = 64;
    for (int i = 2; i + 1 < argc; i += 2) {
        int& value = std::strcmp(argv[i], "--threads") == 0 ? threads : samples;
        std::from_chars(argv[i + 1], argv[i + 1] + std::strlen(argv[i + 1]), value);
    }
    const LoadedScene loaded = load_scene(argv[1]);
    Triangles triangles;
    for (const SceneObject& object : loaded.job.scene->objects()) {
        triangles.is_lamp = object.emitter != nullptr;
        object.shape->add_to(triangles);
    }
    if (triangles.lamps.empty()) throw Error("embree_loop needs a lamp made of triangles");
    triangles.positions.reserve(triangles.positions.size() + 2); // Embree reads past the last vertex

    RTCDevice device = rtcNewDevice(default_instruction_set().embree_config);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               triangles.positions.data(), 0, sizeof(Vec3f), triangles.positions.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.indices.data(),
                               0, sizeof(AccelBuilder::Triangle), triangles.indices.size());
    rtcCommitGeometry(geometry);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);

    Loop loop{scene, triangles.lamps, *loaded.job.camera, loaded.job.camera->resolution(), samples};
    const auto start = std::chrono::steady_clock::now();
    {
        std::vector<std::jthread> pool;
        for (int i = 0; i < threads; ++i) pool.emplace_back([&] { loop.work(); });
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("{\"triangles\": %zu, \"threads\": %d, \"spp\": %d, \"rays\": %llu, \"seconds\": %.4f, "
                "\"rays_per_second\": %.0f, \"mean\": %.6g}\n",
                triangles.indices.size(), threads, samples, static_cast<unsigned long long>(loop.rays.load()),
                seconds, static_cast<double>(loop.rays.load()) / seconds,
                static_cast<double>(loop.sum.load()) / loop.size.x / loop.size.y / samples);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        std::fprintf(stderr, "usage: embree_loop SCENE.xml [--threads N] [--spp N]\n");
        return 2;
    }
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
