// SPDX-License-Identifier: MIT
#pragma once

// One thread's view of the scene: it traces rays, counts them by kind, and on demand notes what a camera sample sees first and
// how it finds its light and, for `renderer replay`, keeps a log.

#include "plumb/scene/light_notes.h"
#include "plumb/scene/path_event.h"
#include "plumb/scene/ray_counts.h"
#include "plumb/scene/scene.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace plumb {

// A surface that a camera sample saw, and how.
struct SeenSurface {
    SurfacePoint at;
    Vec3f direction;      // of the ray that met it, of unit length
    float distance = 0.f; // from the camera along the path
    Color through{
        1.f}; // what the delta bounces before it left of the light, without the scale of refracted radiance
};

// What one camera sample sees first. Every integrator that calls its rays what they are fills it in.
struct FirstSurfaces {
    std::optional<SeenSurface> surface; // of the camera ray
    std::optional<SeenSurface>
        not_delta; // the first that has other than delta lobes, or emits: seen in mirrors and through glass

    void meet(const Ray& ray, RayKind kind, const SurfacePoint& hit);
    void scatter(const Color& weight); // a path goes on from the last surface

private:
    Color through_{1.f};
    float distance_ = 0.f;
};

class Tracer {
public:
    // Where the path, the first surfaces and the contributions of each sample are to be noted; null: nowhere.
    struct Notes {
        std::vector<PathEvent>* log = nullptr;
        FirstSurfaces* first = nullptr;
        LightNotes* light = nullptr;
    };
    explicit Tracer(const Scene& scene, const Notes& notes)
        : scene_(scene),
          log_(notes.log),
          first_(notes.first),
          light_(notes.light),
          watched_(log_ || first_ || light_)
    {}
    explicit Tracer(const Scene& scene) : Tracer(scene, Notes()) {}

    const Scene& scene() const { return scene_; }
    const RayCounts& counts() const { return counts_; }

    std::optional<SurfacePoint> intersect(const Ray& ray, RayKind kind)
    {
        ++counts_.of(kind);
        if (watched() || !is_traceable(ray)) [[unlikely]]
            return intersect_watched(ray, kind);
        return scene_.intersect(ray);
    }
    // The same as if objects that emit were not there.
    std::optional<SurfacePoint> intersect_behind_emitters(const Ray& ray, RayKind kind);
    bool occluded(const Ray& ray)
    {
        ++counts_.shadow;
        if (is_traceable(ray)) [[likely]]
            return scene_.occluded(ray);
        failed_ = true;
        return true;
    }
    // What fraction of the light from the sampled point arrives at `from`: 0 or 1 where no surfaces are there that light
    // passes straight through.
    float visible(const SurfacePoint& from, const EmitterSample& light)
    {
        const Ray ray = Scene::shadow_ray(from, light);
        if (!scene_.has_null_surfaces()) [[likely]]
            return occluded(ray) ? 0.f : 1.f;
        return light.distance == infinity ? transmittance(ray) : transmittance_to_end(ray);
    }
    // What fraction of light passes along a ray. Surfaces attenuate it in the order in which the ray meets them.
    float transmittance(const Ray& ray);
    // Shadow rays that pass more surfaces than these are occluded (integrators that count passes); by default any number.
    void limit_passes(int most) { most_passes_ = most; }

    // How many looks for lamps (Integrator::look()) there are of each sample of the pixel. Above 0, samples leave out what those find.
    int looks() const { return looks_; }
    void expect_looks(int looks) { looks_ = looks; }

    // Whether a ray since the last call was not traceable (ray.h): it met nothing and saw nothing, and the sample that
    // asked for it must not count.
    bool take_failure() { return std::exchange(failed_, false); }

    // Whether anything is noted. One test when nobody asks.
    bool watched() const { return watched_; }
    FirstSurfaces* first_surfaces() const { return first_; }
    LightNotes* light_notes() const { return light_; }
    // Notes a contribution, where somebody asks. sum: with it, as in LightNote.
    void note_light(const Color& sum, FoundBy by, std::uint32_t emitter)
    {
        if (light_) [[unlikely]]
            light_->add({sum, by, emitter});
    }
    // How many there are so far.
    std::size_t noted_light() const { return light_ ? light_->count() : 0; }
    // LightNotes::change_sums(), likewise.
    template <class Map>
    void change_noted_light(std::size_t first, const Map& map)
    {
        if (light_) [[unlikely]]
            light_->change_sums(first, map);
    }
    bool logging() const { return log_ != nullptr; }
    void log(PathEvent::Kind kind, std::string text);
    // A contribution to the pixel: what it is, and throughput times value.
    void log_contribution(PathEvent::Kind kind, const char* what, const Color& contribution);

private:
    // The same for a ray between two points: every piece of it goes to the same end.
    float transmittance_to_end(const Ray& ray);
    template <class Rest>
    float transmittance(Ray ray, const Rest& rest);
    std::optional<SurfacePoint> intersect_watched(const Ray& ray, RayKind kind);
    void note(const Ray& ray, RayKind kind, const std::optional<SurfacePoint>& hit);

    const Scene& scene_;
    RayCounts counts_;
    int most_passes_ = std::numeric_limits<int>::max();
    int looks_ = 0;
    bool failed_ = false;
    std::vector<PathEvent>* log_;
    FirstSurfaces* first_;
    LightNotes* light_;
    bool watched_;
};

} // namespace plumb
