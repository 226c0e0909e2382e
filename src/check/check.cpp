// SPDX-License-Identifier: MIT

#include "plumb/check/check.h"

#include "check/coincidence_doubts.h"
#include "check/mesh_facts.h"
#include "check/precision_doubts.h"
#include "plumb/model/shape.h"
#include "plumb/sampling/sampling.h"
#include "plumb/scene/scene.h"
#include "plumb/scene/tracer.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace plumb {

namespace {

constexpr int samples = 256;

bool transmits(const Bsdf& bsdf)
{
    return bsdf.lobes().has_any(transmission_lobes);
}

bool passes(const Bsdf& bsdf)
{
    return bsdf.lobes().has_any(Lobe::null);
}

class Checker {
public:
    explicit Checker(const RenderJob& job)
        : job_(job),
          scene_(*job.scene),
          size_(length(job.scene->bounds().size())),
          sampler_(job.sampler->clone(samples))
    {}

    std::vector<Doubt> doubts()
    {
        if (scene_.emitters().empty() && job_.integrator->needs_lamps())
            add({}, "there is no light: the image will be black");
        find_facts(scene_.objects());
        for (const Group* group : scene_.groups()) find_facts(group->objects());
        std::sort(borders_.begin(), borders_.end());
        for (const auto& [object, facts] : facts_) check(*object, facts);
        check_camera();
        check_blackness();
        for (Doubt& doubt : precision_doubts(job_)) doubts_.push_back(std::move(doubt));
        for (Doubt& doubt : coincidence_doubts(scene_)) doubts_.push_back(std::move(doubt));
        return std::move(doubts_);
    }

private:
    void add(const std::string& object, std::string text) { doubts_.push_back({object, std::move(text)}); }

    // Of the objects for which it matters where inside and outside are.
    void find_facts(const std::vector<SceneObject>& objects)
    {
        for (const SceneObject& object : objects) {
            const bool has_sides = transmits(*object.bsdf) || object.emitter;
            facts_.push_back({&object, has_sides ? mesh_facts(*object.shape) : MeshFacts()});
            if (!transmits(*object.bsdf)) continue;
            const std::vector<Edge>& edges = facts_.back().second.open_edges;
            borders_.insert(borders_.end(), edges.begin(), edges.end());
        }
    }

    // Surfaces between several media, of glass and of the water in it, close a space together: where one ends, so
    // does another.
    bool is_border_of_another(const Edge& edge) const
    {
        const auto [first, last] = std::equal_range(borders_.begin(), borders_.end(), edge);
        return last - first > 1;
    }

    bool closes_with_others(const MeshFacts& facts) const
    {
        return !facts.open_edges.empty() &&
               std::all_of(facts.open_edges.begin(), facts.open_edges.end(),
                           [this](const Edge& edge) { return is_border_of_another(edge); });
    }

    void check(const SceneObject& object, const MeshFacts& facts)
    {
        if (transmits(*object.bsdf)) check_inside(object, facts);
        if (object.emitter) check_lamp(object, facts);
        check_energy(object);
    }

    void check_inside(const SceneObject& object, const MeshFacts& facts)
    {
        if (facts.is_closed && facts.volume < 0.0)
            add(object.name, "its front faces inwards, so inside and outside are swapped");
        else if (!facts.is_closed && !closes_with_others(facts))
            add(object.name, "light enters its material, but the surface is not closed");
    }

    void check_lamp(const SceneObject& object, const MeshFacts& facts)
    {
        if (!(object.emitter->power() > 0.f)) return add(object.name, "its emitter is black");
        if (facts.is_closed && facts.volume < 0.0 &&
            !object.shape->bounds().intersects(camera_ray(0.5f, 0.5f).origin))
            return add(object.name, "it is closed and shines inwards only");
        const std::optional<float> reach = reach_of(object);
        constexpr float nothing = 1e-3f; // of the scene's size
        if (reach && *reach < nothing * size_)
            add(object.name,
                fmt::format("it faces a wall: its light reaches no farther than {:.3g}", *reach));
    }

    // How far the light of a lamp gets at most; nothing: out of the scene.
    std::optional<float> reach_of(const SceneObject& lamp)
    {
        float reach = 0.f;
        for (int i = 0; i < samples; ++i) {
            sampler_->start(0, {0, 0}, static_cast<std::uint64_t>(i));
            const double u_select = sampler_->next_choice();
            const Vec2f u = sampler_->next_2d();
            const Vec2f u_direction = sampler_->next_2d();
            const ShapeSample point = lamp.shape->sample_area(u_select, u);
            const Vec3f direction = Frame(point.normal).to_world(square_to_cosine_hemisphere(u_direction));
            const Vec3f origin = offset_origin(point.position, point.clearance, point.normal, direction);
            const auto hit = scene_.intersect({origin, direction});
            if (!hit || passes(*hit->bsdf)) return std::nullopt;
            reach = std::max(reach, length(hit->position - origin));
        }
        return reach;
    }

    // The share of light that comes back: the mean weight of samples (undoing what refraction does to radiance).
    void check_energy(const SceneObject& object)
    {
        constexpr double most = 1.02; // the noise of so many samples is far below
        SurfacePoint at;
        at.uv = Vec2f(0.5f);
        for (const float cosine : {0.95f, 0.6f, 0.2f}) {
            const Vec3f wi(std::sqrt(1.f - sqr(cosine)), 0.f, cosine);
            double sum[3] = {0.0, 0.0, 0.0};
            for (int i = 0; i < samples; ++i) {
                sampler_->start(1, {0, 0}, static_cast<std::uint64_t>(i));
                const float u_lobe = sampler_->next_1d();
                const Vec2f u = sampler_->next_2d();
                const auto sample = object.bsdf->sample(at, wi, u_lobe, u);
                if (!sample) continue;
                for (int c = 0; c < 3; ++c)
                    sum[c] += static_cast<double>(sample->weight[c]) * sqr(static_cast<double>(sample->eta));
            }
            const double share = std::max({sum[0], sum[1], sum[2]}) / samples;
            if (share > most)
                return add(object.name,
                           fmt::format("its BSDF scatters {:.3g} times the light that it receives", share));
        }
    }

    // Through a place of the image, from 0 to 1 across and down, and the middle of the lens.
    Ray camera_ray(float across, float down) const
    {
        const Vec2i resolution = job_.camera->resolution();
        const Vec2f raster(across * static_cast<float>(resolution.x),
                           down * static_cast<float>(resolution.y));
        return job_.camera->sample_ray(raster, Vec2f(0.5f)).ray;
    }

    // Inside, if all that it sees is one closed object from behind.
    void check_camera()
    {
        std::optional<SurfacePoint> around;
        for (const Vec2f& place : {Vec2f(0.5f, 0.5f), Vec2f(0.01f, 0.01f), Vec2f(0.99f, 0.01f),
                                   Vec2f(0.01f, 0.99f), Vec2f(0.99f, 0.99f)}) {
            const Ray ray = camera_ray(place.x, place.y);
            const auto hit = scene_.intersect(ray);
            if (!hit || dot(hit->geometric_normal, ray.direction) <= 0.f) return;
            if (around && (around->shape != hit->shape || around->instance != hit->instance)) return;
            around = *hit;
        }
        if (!around || passes(*around->bsdf)) return;
        const MeshFacts facts = mesh_facts(*around->shape);
        if (facts.is_closed && facts.volume > 0.0) add(scene_.name_of(*around), "the camera is inside it");
    }

    // Looks at a grid of places in the image as the integrator does.
    void check_blackness()
    {
        if (scene_.emitters().empty() || !job_.integrator->needs_lamps()) return;
        constexpr int side = 32;
        constexpr std::uint64_t looks = 4; // at each place
        Tracer tracer(scene_);
        const Vec2f cell = Vec2f(job_.camera->resolution()) / static_cast<float>(side);
        for (std::uint64_t look = 0; look < looks; ++look)
            for (int i = 0; i < side * side; ++i) {
                const Vec2i place(i % side, i / side);
                sampler_->start(2, place, look);
                const Vec2f u = sampler_->next_2d();
                const Vec2f u_lens = sampler_->next_2d();
                const CameraRay seen = job_.camera->sample_ray((Vec2f(place) + u) * cell, u_lens);
                const Color light = job_.integrator->radiance(tracer, *sampler_, seen.ray) * seen.weight;
                if (!light.is_black()) return;
            }
        add({}, fmt::format("although there {}, all {} paths through the image are black",
                            scene_.emitters().size() == 1
                                ? "is a light"
                                : fmt::format("are {} lights", scene_.emitters().size()),
                            looks * side * side));
    }

    const RenderJob& job_;
    const Scene& scene_;
    float size_;
    std::unique_ptr<Sampler> sampler_;
    std::vector<std::pair<const SceneObject*, MeshFacts>>
        facts_;                 // of the scene's objects, and of the groups'
    std::vector<Edge> borders_; // open edges of every object that light enters, sorted
    std::vector<Doubt> doubts_;
};

} // namespace

std::vector<Doubt> find_doubts(const RenderJob& job)
{
    return Checker(job).doubts();
}

} // namespace plumb
