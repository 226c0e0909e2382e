// SPDX-License-Identifier: MIT
#pragma once

// One thread's view of the scene: it traces rays, counts them by kind, and for `renderer replay` keeps a log.

#include "plumb/scene/scene.h"

#include <string>
#include <utility>
#include <vector>

namespace plumb {

enum class RayKind { camera, bounce, shadow };

struct RayCounts {
    std::uint64_t camera = 0;
    std::uint64_t bounce = 0;
    std::uint64_t shadow = 0;

    std::uint64_t total() const { return camera + bounce + shadow; }
    std::uint64_t& of(RayKind kind)
    {
        return kind == RayKind::camera ? camera : kind == RayKind::bounce ? bounce : shadow;
    }
    RayCounts& operator+=(const RayCounts& other);
};

// What happened along one path, in order, for people to read.
struct PathEvent {
    enum class Kind { ray, hit, escape, emission, direct, scatter, roulette, end };
    Kind kind;
    std::string text;
};

class Tracer {
public:
    explicit Tracer(const Scene& scene, std::vector<PathEvent>* log = nullptr) : scene_(scene), log_(log) {}

    const Scene& scene() const { return scene_; }
    const RayCounts& counts() const { return counts_; }

    std::optional<SurfacePoint> intersect(const Ray& ray, RayKind kind)
    {
        ++counts_.of(kind);
        if (logging() || !is_traceable(ray)) [[unlikely]]
            return intersect_with_log(ray, kind);
        return scene_.intersect(ray);
    }
    bool occluded(const Ray& ray)
    {
        ++counts_.shadow;
        if (is_traceable(ray)) [[likely]]
            return scene_.occluded(ray);
        failed_ = true;
        return true;
    }
    // Whether light from the sampled point arrives at `from`.
    bool visible(const SurfacePoint& from, const EmitterSample& light)
    {
        return !occluded(Scene::shadow_ray(from, light));
    }

    // Whether a ray since the last call was not traceable (ray.h): it met nothing and saw nothing, and the sample that
    // asked for it must not count.
    bool take_failure() { return std::exchange(failed_, false); }

    // The log costs one test of a pointer when nobody reads it.
    bool logging() const { return log_ != nullptr; }
    void log(PathEvent::Kind kind, std::string text);
    // A contribution to the pixel: what it is, and throughput times value.
    void log_contribution(PathEvent::Kind kind, const char* what, const Color& contribution);

private:
    std::optional<SurfacePoint> intersect_with_log(const Ray& ray, RayKind kind);

    const Scene& scene_;
    RayCounts counts_;
    bool failed_ = false;
    std::vector<PathEvent>* log_;
};

} // namespace plumb
