// SPDX-License-Identifier: MIT

#include "integrators/sky_guide.h"

#include "base/float_mode.h"
#include "base/parallel.h"
#include "integrators/sky_window.h"
#include "integrators/vertex.h"
#include "plumb/sampling/sampling.h"
#include "plumb/scene/tracer.h"
#include "samplers/hashed.h"

#include <chrono>

namespace plumb {
namespace {

constexpr std::size_t paths_of_a_part = 64;
constexpr std::size_t parts = 64;
constexpr std::size_t first_lesson = 16;     // after which the others know where to look
constexpr std::uint64_t path_key = 0x736b79; // "sky"
constexpr int most_bounces = 4;              // from surfaces that scatter
constexpr int most_hits = 32;                // passes and delta bounces included
constexpr std::size_t looks = 8;             // into the sky from each surface, of each kind
constexpr std::size_t most_places = 256;     // of a cell

} // namespace

SkyRectangle SkyGuide::Window::seen_from(const Vec3f& position) const
{
    const Vec3f way = position - center;
    const float x = dot(slope_x, way);
    const float y = dot(slope_y, way);
    const float left = view.left + x;
    SkyRectangle seen;
    seen.left = std::clamp(left - std::floor(left), 0.f, one_minus_epsilon);
    seen.width = view.width;
    seen.top = std::clamp(view.top + y, 0.f, 1.f);
    seen.bottom = std::clamp(view.bottom + y, 0.f, 1.f);
    return seen;
}

// What a guide is learnt from.
class SkyLesson {
public:
    SkyLesson(const Scene& scene, const Camera& camera) : scene_(scene), camera_(camera)
    {
        int infinite = 0;
        for (const Emitter* emitter : scene.emitters()) {
            if (!emitter->is_infinite() || emitter->is_delta()) continue;
            sky_ = emitter;
            ++infinite;
        }
        if (infinite == 1) map_ = sky_->sky_map(); // several overlap, and none knows of the others
    }

    bool has_sky() const { return map_ != nullptr; }

    // A place that light was looked for from; rays that found some.
    struct Place {
        Vec3f position;
        std::size_t side;
        std::vector<SkyRay> rays;
    };

    // Follows a path from the camera, and looks for the sky from each surface that scatters.
    void follow_path(std::uint64_t index, const SkyGuide& so_far, std::vector<Place>& places) const
    {
        Tracer tracer(scene_);
        RandomStream random(random_word(path_key, index));
        const Vec2f film = random.next_2d();
        const Vec2f lens = random.next_2d();
        const Vec2f size(camera_.resolution());
        Ray ray = camera_.sample_ray({film.x * size.x, film.y * size.y}, lens).ray;
        int bounces = 0;
        for (int surfaces = 0; surfaces < most_hits; ++surfaces) {
            if (!is_traceable(ray)) return;
            const auto hit = scene_.intersect(ray);
            if (!hit || (hit->emitter && scene_.emitters_absorb())) return;
            const Vertex vertex(*hit, ray.direction);
            if (vertex.has_smooth_lobes()) places.push_back(look_around(tracer, random, vertex, so_far));
            const float u_lobe = random.next_1d();
            const Vec2f u = random.next_2d();
            const float u_survival = random.next_1d();
            const std::optional<BsdfSample> next = vertex.sample(u_lobe, u);
            if (!next) return;
            if (next->is_pass()) {
                ray = hit->spawn_ray(ray.direction);
                continue;
            }
            if (!next->is_delta() && ++bounces == most_bounces) return;
            if (!(u_survival < max_component(next->weight) * sqr(next->eta))) return;
            ray = hit->spawn_ray(vertex.to_world(*next));
        }
    }

    SkyGuide learn(std::span<const Place> places, int threads) const
    {
        SkyGuide guide;
        guide.map_ = map_;
        for (std::size_t s = 0; s < SkyGuide::sides; ++s) {
            std::vector<const Place*> mine;
            std::vector<Vec3f> points;
            for (const Place& place : places) {
                if (place.side != s) continue;
                mine.push_back(&place);
                points.push_back(place.position);
            }
            if (mine.empty()) continue;
            SkyGuide::Side& side = guide.sides_[s];
            CellTree::Members members;
            side.cells = CellTree(points, most_places, members);
            std::vector<std::optional<SkyGuide::Window>> windows(side.cells.nodes());
            parallel_for(windows.size(), threads, [&](std::size_t node) {
                if (!side.cells.is_leaf(node)) return;
                const FlushDenormals flush;
                std::vector<SkyRay> rays;
                for (const std::uint32_t i : members.of(node))
                    rays.insert(rays.end(), mine[i]->rays.begin(), mine[i]->rays.end());
                windows[node] = fit_window(*map_, rays);
            });
            for (const std::optional<SkyGuide::Window>& window : windows) {
                side.window_of_node.push_back(window ? static_cast<std::uint32_t>(guide.windows_.size())
                                                     : SkyGuide::none);
                if (window) guide.windows_.push_back(*window);
            }
        }
        return guide;
    }

private:
    // Into directions of the sky and into those that a diffuse surface scatters to, weighted against each other (Veach 1997, section
    // 9.2, balance heuristic).
    Place look_around(Tracer& tracer, RandomStream& random, const Vertex& vertex,
                      const SkyGuide& so_far) const
    {
        const LightReceiver everything = vertex.receiver();
        LightReceiver receiver = everything;
        receiver.sky = so_far.view_at(receiver.position, receiver.normal);
        const bool is_two_sided = receiver.normal == Vec3f(0.f);
        const Frame frame(is_two_sided ? Vec3f(0.f, 0.f, 1.f) : receiver.normal);
        Place place{receiver.position, SkyGuide::side_of(receiver.normal), {}};
        const auto look = [&](const Vec3f& wi) {
            const float cosine = is_two_sided ? 1.f : dot(receiver.normal, wi);
            if (!(cosine > 0.f)) return;
            const EmitterValue sky = sky_->evaluate(receiver, wi, nullptr, Measure::best);
            const float pdf_of_all = sky_->evaluate(everything, wi, nullptr, Measure::best).pdf;
            const float of_surface = is_two_sided ? uniform_sphere_pdf() : cosine * inv_pi;
            const float light = cosine * luminance(sky.radiance);
            if (!(light > 0.f) || !(pdf_of_all > 0.f)) return;
            const float value = light * tracer.transmittance(vertex.at().spawn_ray(wi));
            if (!(value > 0.f)) return;
            const double moment = sqr(static_cast<double>(value)) /
                                  static_cast<double>(0.5f * (sky.pdf + of_surface) * pdf_of_all);
            place.rays.push_back({receiver.position, map_->place_of(wi), moment});
        };
        const Vec2f shift = random.next_2d();
        for (std::size_t i = 0; i < looks; ++i) {
            // Hammersley's points, shifted in their squares.
            const auto reversed = static_cast<float>(((i & 1) << 2) | (i & 2) | ((i & 4) >> 2));
            const Vec2f u((reversed + shift.x) / looks, (static_cast<float>(i) + shift.y) / looks);
            const double u_select = random.next_choice();
            if (const auto light = sky_->sample(receiver, u_select, u, Measure::best)) look(light->wi);
            look(is_two_sided ? square_to_uniform_sphere(u) : frame.to_world(square_to_cosine_hemisphere(u)));
        }
        return place;
    }

    const Scene& scene_;
    const Camera& camera_;
    const Emitter* sky_ = nullptr;
    const SkyMap* map_ = nullptr;
};

SkyGuide SkyGuide::learn(const Scene& scene, const Camera& camera, int threads)
{
    const auto start = std::chrono::steady_clock::now();
    const SkyLesson lesson(scene, camera);
    SkyGuide guide;
    if (!lesson.has_sky()) return guide;
    std::vector<SkyLesson::Place> places;
    const auto go_on = [&](std::size_t first, std::size_t end) {
        std::vector<std::vector<SkyLesson::Place>> of_parts(end - first);
        parallel_for(of_parts.size(), threads, [&](std::size_t part) {
            const FlushDenormals flush;
            for (std::size_t i = 0; i < paths_of_a_part; ++i)
                lesson.follow_path((first + part) * paths_of_a_part + i, guide, of_parts[part]);
        });
        for (std::vector<SkyLesson::Place>& part : of_parts)
            for (SkyLesson::Place& place : part) places.push_back(std::move(place));
        guide = lesson.learn(places, threads);
        guide.paths_ = end * paths_of_a_part;
    };
    go_on(0, first_lesson);
    if (guide.is_on()) go_on(first_lesson, parts);
    guide.seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return guide;
}

} // namespace plumb
