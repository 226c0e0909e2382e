// SPDX-License-Identifier: MIT
#include "check/coincidence_doubts.h"

#include "check/coincidence.h"
#include "plumb/sampling.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

// How far off they must be, in what counts as one surface.
constexpr double gap_factor = 16.0;

bool transmits(const SceneObject& object)
{
    return object.bsdf->lobes().has_any(transmission_lobes);
}

// Whether all that is seen from a side of the surfaces are backs: the inside of a body.
bool is_enclosed(const Scene& scene, const CoincidentPlace& place, double side, double offset)
{
    constexpr int rays = 6; // in each of two dimensions
    const Vec3f normal = place.front * static_cast<float>(side);
    const Vec3f origin = place.position + normal * static_cast<float>(offset);
    const Frame frame(normal);
    for (int i = 0; i < rays * rays; ++i) {
        const Vec2f u((static_cast<float>(i % rays) + 0.5f) / rays,
                      (static_cast<float>(i / rays) + 0.5f) / rays);
        const Vec3f direction = frame.to_world(square_to_cosine_hemisphere(u));
        const auto hit = scene.intersect({origin, direction});
        if (!hit || dot(hit->geometric_normal, direction) <= 0.f) return false;
    }
    return true;
}

class Speaker {
public:
    explicit Speaker(const Scene& scene) : scene_(scene) {}

    std::vector<Doubt> doubts() const
    {
        const Coincidences coincidences = find_coincidences(scene_);
        std::vector<Doubt> doubts;
        for (const Coincidence& one : coincidences.found)
            if (matters(one)) doubts.push_back(doubt(one));
        if (!coincidences.is_complete)
            doubts.push_back({"", "too many triangles lie close together to compare them all: coincident "
                                  "surfaces may have been missed"});
        return doubts;
    }

private:
    const SceneObject& object(std::size_t i) const { return scene_.objects()[i]; }

    bool matters(const Coincidence& one) const
    {
        if (one.faces_alike || transmits(object(one.first)) || transmits(object(one.second))) return true;
        return std::any_of(one.places.begin(), one.places.end(), [&](const CoincidentPlace& place) {
            const double offset = gap_factor * one.tolerance;
            return !is_enclosed(scene_, place, 1.0, offset) && !is_enclosed(scene_, place, -1.0, offset);
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
};

} // namespace

std::vector<Doubt> coincidence_doubts(const Scene& scene)
{
    return Speaker(scene).doubts();
}

} // namespace plumb
