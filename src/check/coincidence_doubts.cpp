// SPDX-License-Identifier: MIT
#include "check/coincidence_doubts.h"

#include "check/coincidence.h"
#include "plumb/sampling/sampling.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace plumb {

namespace {

// How far off they must be, in what counts as one surface.
constexpr double gap_factor = 16.0;

bool transmits(const SceneObject& object)
{
    return object.bsdf->lobes().has_any(transmission_lobes);
}

// As an instance, or null, puts it into the scene.
Ray in_scene(const InstanceMap* map, const Ray& ray)
{
    if (map == nullptr) return ray;
    return {Vec3f(map->to_world(Vec3d(ray.origin))),
            map->to_world(Tangents{ray.direction, Vec3f(0.f)}).dp_du};
}

// Whether all that is seen from a side of the surfaces are backs: the inside of a body.
bool is_enclosed(const Scene& scene, const InstanceMap* map, const CoincidentPlace& place, double side,
                 double offset)
{
    constexpr int rays = 6; // in each of two dimensions
    const Vec3f normal = place.front * static_cast<float>(side);
    const Vec3f origin = place.position + normal * static_cast<float>(offset);
    const Frame frame(normal);
    for (int i = 0; i < rays * rays; ++i) {
        const Vec2f u((static_cast<float>(i % rays) + 0.5f) / rays,
                      (static_cast<float>(i / rays) + 0.5f) / rays);
        const Vec3f direction = frame.to_world(square_to_cosine_hemisphere(u));
        const Ray ray = in_scene(map, {origin, direction});
        const auto hit = scene.intersect(ray);
        if (!hit || dot(hit->geometric_normal, ray.direction) <= 0.f) return false;
    }
    return true;
}

class Speaker {
public:
    // map: of the instance whose group has the objects; null: the scene has them.
    Speaker(const Scene& scene, const std::vector<SceneObject>& objects, const InstanceMap* map)
        : scene_(scene), objects_(objects), map_(map)
    {}

    std::vector<Doubt> doubts() const
    {
        const Coincidences coincidences = find_coincidences(objects_);
        std::vector<Doubt> doubts;
        for (const Coincidence& one : coincidences.found)
            if (matters(one)) doubts.push_back(doubt(one));
        if (!coincidences.is_complete)
            doubts.push_back({"", "too many triangles lie close together to compare them all: coincident "
                                  "surfaces may have been missed"});
        return doubts;
    }

private:
    const SceneObject& object(std::size_t i) const { return objects_[i]; }

    bool matters(const Coincidence& one) const
    {
        if (one.faces_alike || transmits(object(one.first)) || transmits(object(one.second))) return true;
        return std::any_of(one.places.begin(), one.places.end(), [&](const CoincidentPlace& place) {
            const double offset = gap_factor * one.tolerance;
            return !is_enclosed(scene_, map_, place, 1.0, offset) &&
                   !is_enclosed(scene_, map_, place, -1.0, offset);
        });
    }

    // It stands with the object that suffers most: the glass, else the lamp, else the first.
    Doubt doubt(const Coincidence& one) const
    {
        std::size_t subject = one.first, other = one.second;
        const auto rank = [&](std::size_t i) { return transmits(object(i)) ? 2 : object(i).emitter ? 1 : 0; };
        if (rank(other) > rank(subject)) std::swap(subject, other);
        const Vec3f& at = one.places.front().position;
        const std::string place = fmt::format("around ({:.4g}, {:.4g}, {:.4g})", at.x, at.y, at.z);
        const std::string where = subject == other
                                      ? fmt::format("parts of it coincide {}", place)
                                      : fmt::format("it coincides with {} {}", object(other).name, place);
        return {object(subject).name, fmt::format("{}: {}", where, consequence(one, subject, other))};
    }

    std::string consequence(const Coincidence& one, std::size_t subject, std::size_t other) const
    {
        const std::string gap = fmt::format("{:.1g}", gap_factor * one.tolerance);
        if (transmits(object(subject)))
            return fmt::format("paths miss one of the two surfaces, so light takes wrong paths; leave a gap "
                               "of at least {}, or let them intersect",
                               gap);
        if (object(subject).emitter && object(other).emitter && one.faces_alike)
            return fmt::format("rays hit only one of two emitters in one place, but both are sampled, so "
                               "integrators disagree; remove one, or leave a gap of at least {}",
                               gap);
        if (object(subject).emitter)
            return fmt::format("where rays hit the other surface the emitter is dark, yet it is sampled "
                               "there, so integrators disagree; move the emitter at least {} to its front",
                               gap);
        if (!one.faces_alike)
            return fmt::format("rays hit the front of one or the black back of the other by chance; leave a "
                               "gap of at least {}",
                               gap);
        if (subject == other)
            return "rays hit either of them by chance, which is visible if their normals or texture "
                   "coordinates differ";
        return fmt::format("rays hit either of them by chance, which is visible if their BSDFs differ; "
                           "remove one, or leave a gap of at least {}",
                           gap);
    }

    const Scene& scene_;
    const std::vector<SceneObject>& objects_;
    const InstanceMap* map_;
};

// The first instance that is in the place of another one.
std::optional<Doubt> repeated_instance(const Scene& scene)
{
    std::vector<const Instance*> sorted;
    for (const Instance& instance : scene.instances()) sorted.push_back(&instance);
    const auto key = [](const Instance* i) { return std::tie(i->group, i->rows()); };
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](const Instance* a, const Instance* b) { return key(a) < key(b); });
    const auto same = std::adjacent_find(
        sorted.begin(), sorted.end(), [&](const Instance* a, const Instance* b) { return key(a) == key(b); });
    if (same == sorted.end()) return std::nullopt;
    return Doubt{(*std::next(same))->name,
                 fmt::format("it is in the same place as {}; remove one of them", (*same)->name)};
}

} // namespace

std::vector<Doubt> coincidence_doubts(const Scene& scene)
{
    std::vector<Doubt> doubts = Speaker(scene, scene.objects(), nullptr).doubts();
    for (const Group* group : scene.groups()) {
        const auto first = std::find_if(scene.instances().begin(), scene.instances().end(),
                                        [&](const Instance& one) { return one.group.get() == group; });
        for (Doubt& doubt : Speaker(scene, group->objects(), &*first).doubts())
            doubts.push_back(std::move(doubt));
    }
    if (auto doubt = repeated_instance(scene)) doubts.push_back(*std::move(doubt));
    return doubts;
}

} // namespace plumb
