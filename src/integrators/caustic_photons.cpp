// SPDX-License-Identifier: MIT

#include "integrators/caustic_photons.h"

#include "base/float_mode.h"
#include "base/parallel.h"
#include "integrators/vertex.h"
#include "plumb/model/shape.h"
#include "plumb/sampling/distribution.h"
#include "plumb/sampling/sampling.h"
#include "plumb/scene/tracer.h"
#include "samplers/hashed.h"

#include <algorithm>
#include <unordered_map>

namespace plumb {
namespace {

constexpr std::size_t photons_of_a_part = 1024;
// If fewer photons of the first parts arrive, there is nothing to learn, and no more are emitted.
constexpr std::size_t first_parts = 16;
constexpr std::size_t fewest_of_first_parts = 32;
constexpr std::uint64_t photon_key = 0x63617573746963; // "caustic"
constexpr int most_surfaces = 64;                      // passes through null lobes included
constexpr std::size_t most_targets = 64;

bool throws_caustics(const SceneObject& object)
{
    return throw_caustics(object.bsdf->lobes());
}

Ball ball_around(const Box3f& box)
{
    return {box.center(), 0.5f * length(box.size())};
}

// Balls around what throws caustics: what photons are aimed at, or few would meet it.
std::vector<Ball> find_targets(const Scene& scene)
{
    std::vector<Ball> targets;
    Box3f all;
    for (const SceneObject& object : scene.objects()) {
        if (!throws_caustics(object)) continue;
        all.extendBy(object.shape->bounds());
        targets.push_back(object.shape->as_ball().value_or(ball_around(object.shape->bounds())));
    }
    std::unordered_map<const Group*, bool>
        groups; // which of them are targets: looked at once, not for each instance
    for (const Instance& instance : scene.instances()) {
        const auto [group, is_new] = groups.try_emplace(instance.group.get(), false);
        if (is_new) {
            const std::vector<SceneObject>& objects = instance.group->objects();
            group->second = std::any_of(objects.begin(), objects.end(), throws_caustics);
        }
        if (!group->second) continue;
        all.extendBy(instance.bounds());
        targets.push_back(ball_around(instance.bounds()));
    }
    if (targets.size() > most_targets) targets = {ball_around(all)};
    return targets;
}

// 1 - cos of half the angle that a ball subtends; 2 from inside.
float one_minus_cos_towards(const Ball& ball, const Vec3f& from)
{
    const float sine2 = sqr(ball.radius) / length_squared(ball.center - from);
    if (!(sine2 < 1.f)) return 2.f;
    return one_minus_cos_of(sine2);
}

// An emitter that paths can meet; the shape of it, or null where it is infinite.
struct Lamp {
    const Emitter* emitter;
    const SceneObject* object;
};

class PhotonSource {
public:
    explicit PhotonSource(const Scene& scene) : scene_(scene), targets_(find_targets(scene))
    {
        if (targets_.empty()) return;
        const Box3f bounds = scene.bounds();
        everything_ = ball_around(bounds);
        std::vector<double> weights;
        const auto add = [&](const Lamp& lamp) {
            lamps_.push_back(lamp);
            weights.push_back(static_cast<double>(lamp.emitter->power()) * part_at_targets(lamp));
            flux_ += weights.back();
        };
        for (const SceneObject& object : scene.objects())
            if (object.emitter && !object.emitter->is_delta()) add({object.emitter.get(), &object});
        for (const Emitter* emitter : scene.emitters())
            if (emitter->is_infinite() && !emitter->is_delta()) add({emitter, nullptr});
        choice_ = DiscreteDistribution(weights);
        double area = 0.0;
        for (const Ball& target : targets_) largest_areas_.push_back(area += sqr(target.radius));
    }

    bool can_emit() const { return choice_.can_sample(); }
    // What emitters send towards the targets, luminance: each photon stands for an equal part of it.
    double flux() const { return flux_; }

    // Where the photon begins. Nothing for the part of them by which the others become as many as the light is bright.
    struct Emission {
        Ray ray;
        float before; // distance from the emitter to the ray's origin
    };
    std::optional<Emission> emit(RandomStream& random) const
    {
        const DiscreteDistribution::Choice choice = choice_.sample(random.next_choice());
        const Lamp& lamp = lamps_[choice.index];
        return lamp.object ? emit_from_surface(lamp, choice.u, random)
                           : emit_from_afar(lamp, choice.u, random);
    }

private:
    // How much of the lamp's light goes where photons are aimed, roughly: twice where two targets overlap.
    double part_at_targets(const Lamp& lamp) const
    {
        double part = 0.0;
        for (const Ball& target : targets_)
            part += lamp.object ? 2.0 * static_cast<double>(one_minus_cos_towards(
                                            target, lamp.object->shape->bounds().center()))
                                : static_cast<double>(sqr(target.radius / everything_.radius));
        return part;
    }

    // [1] has photons from lamps along cosines; here into the cones of the targets, and the cosine decides which of them count.
    std::optional<Emission> emit_from_surface(const Lamp& lamp, double u_select, RandomStream& random) const
    {
        const ShapeSample point = lamp.object->shape->sample_area(u_select, random.next_2d());
        std::array<float, most_targets> ends;
        float sum = 0.f;
        for (std::size_t i = 0; i < targets_.size(); ++i) {
            const Ball& target = targets_[i];
            const bool is_behind = dot(target.center - point.position, point.normal) < -target.radius;
            ends[i] = sum += is_behind ? 0.f : one_minus_cos_towards(target, point.position);
        }
        const float place = random.next_1d() * sum;
        const Vec2f u = random.next_2d();
        const float u_count = random.next_1d();
        if (!(sum > 0.f)) return std::nullopt;
        std::size_t chosen = 0;
        while (chosen + 1 < targets_.size() && !(place < ends[chosen])) ++chosen;
        const float one_minus_cos = one_minus_cos_towards(targets_[chosen], point.position);
        const Vec3f axis =
            one_minus_cos < 2.f ? normalize(targets_[chosen].center - point.position) : point.normal;
        const Vec3f direction = Frame(axis).to_world(square_to_uniform_cone(u, one_minus_cos));
        const float cosine = dot(direction, point.normal);
        if (!(cosine > 0.f)) return std::nullopt;

        SurfacePoint at;
        at.position = point.position;
        at.clearance = point.clearance;
        at.geometric_normal = point.normal;
        at.uv = point.uv;
        at.shape = lamp.object->shape.get();
        at.bsdf = lamp.object->bsdf.get();
        at.emitter = lamp.emitter;
        const Color radiance =
            lamp.emitter->evaluate({point.position + direction}, -direction, &at, Measure::area).radiance;
        const float mean = lamp.emitter->power() / (pi * lamp.object->shape->area());
        if (!(u_count * mean < cosine * luminance(radiance))) return std::nullopt;
        return Emission{at.spawn_ray(direction), 0.f};
    }

    std::optional<Emission> emit_from_afar(const Lamp& lamp, double u_select, RandomStream& random) const
    {
        const auto light =
            lamp.emitter->sample({everything_.center}, u_select, random.next_2d(), Measure::best);
        const double place = random.next_choice() * largest_areas_.back();
        const Vec2f u = random.next_2d();
        const float u_count = random.next_1d();
        if (!light || !(light->pdf > 0.f)) return std::nullopt;
        const float mean = lamp.emitter->power() / (pi * sqr(everything_.radius));
        if (!(u_count * mean < luminance(light->radiance) / light->pdf)) return std::nullopt;
        std::size_t chosen = 0;
        while (chosen + 1 < targets_.size() && !(place < largest_areas_[chosen])) ++chosen;
        const Ball& target = targets_[chosen];
        const Vec2f disk = square_to_concentric_disk(u) * target.radius;
        const float outside = 2.f * everything_.radius + length(target.center - everything_.center);
        const Vec3f origin = target.center + Frame(light->wi).to_world(Vec3f(disk.x, disk.y, outside));
        return Emission{Ray(origin, -light->wi), 1e3f * everything_.radius};
    }

    const Scene& scene_;
    std::vector<Ball> targets_;
    Ball everything_;
    std::vector<Lamp> lamps_;
    DiscreteDistribution choice_; // of lamps_
    double flux_ = 0.0;
    std::vector<double> largest_areas_; // of the targets seen from afar, added up
};

// From one emitter sample.
float direct_irradiance(Tracer& tracer, const Vertex& vertex, double u_choice, const Vec2f& u)
{
    const auto light = tracer.scene().sample_emitter(vertex.receiver(), u_choice, u);
    if (!light) return 0.f;
    const float cosine = std::abs(dot(light->wi, vertex.at().shading.n));
    return luminance(light->radiance) * cosine / light->pdf * tracer.visible(vertex.at(), *light);
}

// Follows one photon, and adds where it arrives.
void trace_photon(Tracer& tracer, const PhotonSource& source, std::uint64_t index,
                  std::vector<CausticPhoton>& photons)
{
    const Scene& scene = tracer.scene();
    RandomStream random(random_word(photon_key, index));
    const auto emission = source.emit(random);
    if (!emission) return;
    Ray ray = emission->ray;
    float to_emitter = emission->before;
    float to_last = 0.f;
    int chain = 0;
    bool is_glossy = false;
    for (int surfaces = 0; surfaces < most_surfaces; ++surfaces) {
        if (!is_traceable(ray)) return;
        const auto hit = scene.intersect(ray);
        if (!hit) return;
        const float way = length(hit->position - ray.origin);
        to_emitter += way;
        to_last += way;
        const Vertex vertex(*hit, ray.direction);
        const float u_lobe = random.next_1d();
        const Vec2f u = random.next_2d();
        const float u_survival = random.next_1d();
        const std::optional<BsdfSample> next = vertex.sample(u_lobe, u);
        if (!next) return; // black from there
        if (chain > 0 && vertex.has_diffuse_lobes()) {
            const double u_choice = random.next_choice();
            const Vec2f u_light = random.next_2d();
            photons.push_back({hit->position, -ray.direction, std::abs(dot(hit->shading.n, ray.direction)),
                               to_last, direct_irradiance(tracer, vertex, u_choice, u_light), is_glossy,
                               to_emitter});
        }
        if (!vertex.is_link(*next) || (hit->emitter && scene.emitters_absorb())) return;
        if (next->is_pass()) {
            ray = hit->spawn_ray(ray.direction);
            continue;
        }
        if (++chain > longest_chain) return;
        is_glossy = is_glossy || !next->is_delta();
        // What is left of the light as power, as in PathState.
        if (!(u_survival < max_component(next->weight) * sqr(next->eta))) return;
        to_last = 0.f;
        ray = hit->spawn_ray(vertex.to_world(*next));
    }
}

} // namespace

CausticPhotons trace_caustic_photons(const Scene& scene, std::size_t photons, int threads)
{
    const PhotonSource source(scene);
    CausticPhotons found;
    if (!source.can_emit()) return found;
    const auto emit = [&](std::size_t first, std::size_t end) {
        std::vector<std::vector<CausticPhoton>> of_parts(end - first);
        parallel_for(of_parts.size(), threads, [&](std::size_t part) {
            const FlushDenormals flush;
            Tracer tracer(scene);
            for (std::size_t i = 0; i < photons_of_a_part; ++i)
                trace_photon(tracer, source, (first + part) * photons_of_a_part + i, of_parts[part]);
        });
        found.emitted = end * photons_of_a_part;
        found.flux = source.flux() / static_cast<double>(found.emitted);
        for (const std::vector<CausticPhoton>& arrived : of_parts)
            found.photons.insert(found.photons.end(), arrived.begin(), arrived.end());
    };
    const std::size_t parts = (photons + photons_of_a_part - 1) / photons_of_a_part;
    emit(0, std::min(first_parts, parts));
    if (parts > first_parts && found.photons.size() >= fewest_of_first_parts) emit(first_parts, parts);
    return found;
}

} // namespace plumb
