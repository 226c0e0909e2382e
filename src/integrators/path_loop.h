// SPDX-License-Identifier: MIT
#pragma once

// The loop of every integrator that follows a path from the camera. What distinguishes them is a technique:
//
//     int max_depth() const                                     surface bounces; negative: any number
//     bool counts_passes() const                                is a pass through a null lobe a bounce?
//     bool counts_emission(const PathState&) const              does the path's last direction count what it meets?
//     float emission_weight(const PathState&, float light_pdf) const     and with which weight?
//     Color direct(Tracer&, Sampler&, const Vertex&) const      light that reaches the vertex by other means; may also ask
//                                                               for the PathState, after the Sampler
//     std::optional<BsdfSample> scatter(Sampler&, const Vertex&) const   where the path goes on
//     float survival(const PathState&, int bounces) const       the chance that it does; 1: no roulette
//     bool hides_emitters() const                               optional: does the camera see through emitters?
//     SkyView sky_at(const Vertex&) const                       optional: what is known there of an environment (sky_view.h)
//     bool sees_only_lamps                                      optional, static: does light from outside the scene not count?
//
// and, all or none, of techniques that look for emitters behind links by other means, too (guided_path.h):
//
//     State                                                     a PathState that knows more
//     float chain_weight(const State&, int more_links) const    the weight of what the path finds, so many links on
//     void find_chains(Tracer&, Sampler&, State&, const Vertex&, int bounces) const
//                                                               looks by the other means; what is found waits in the state
//     Color with_waiting(Tracer&, State&, int depth, const Color& sum) const
//                                                               the sum so far, and what waits of no more than that depth

#include "integrators/vertex.h"
#include "plumb/model/sampler.h"
#include "plumb/scene/tracer.h"

namespace plumb {

// Bounces after which the camera sees a lamp (PathState::sees).
inline constexpr int longest_look = 64;

// What a path remembers of its way.
struct PathState {
    explicit PathState(const Vec3f& camera) : receiver{camera} {}

    Color throughput{1.f};
    // What refraction has scaled radiance by, undone: throughput * eta_scale is what fraction of the light, as power,
    // is left, and what roulette looks at. Otherwise a path inside glass would end too early, for its throughput is
    // 1/eta^2 there until it leaves (pbrt 4th ed., section 13.4).
    float eta_scale = 1.f;
    LightReceiver receiver; // the camera or the last vertex
    float pdf = 0.f;        // of the last direction, unless delta
    bool delta = true;   // nothing but following the path finds what it sees: camera rays and delta bounces
    bool is_view = true; // the camera still looks along it, perhaps through panes that do not bend it
    // Whether what it meets is seen by the camera: after delta bounces, or a glossy one that is the last; and after how many.
    bool sees = true;
    bool sees_by_gloss = false;
    int sees_after = 0;
    bool is_chosen = false;       // some direction of it was chosen among many
    bool has_glossy = false;      // some vertex of it was glossy
    bool is_first_glossy = false; // and the last is the first of those

    bool would_be_first_glossy(const Vertex& vertex) const { return !has_glossy && vertex.is_glossy(); }
    // Whether the camera sees what a direction from the vertex meets: a delta one, or any other.
    bool would_see_by_delta() const { return sees && !sees_by_gloss && sees_after < longest_look; }
    bool would_see_by_gloss(const Vertex& vertex) const { return would_see_by_delta() && vertex.is_glossy(); }

    // Light that lies behind a pass is still looked for from the last vertex.
    void pass(const BsdfSample& next) { throughput *= next.weight; }

    void extend(const Vertex& vertex, const BsdfSample& next)
    {
        throughput *= next.weight;
        eta_scale *= sqr(next.eta);
        receiver = vertex.receiver();
        pdf = next.pdf;
        delta = next.is_delta();
        is_view = is_view && next.is_delta() && next.is_transmission() && vertex.goes_straight(next);
        is_chosen = is_chosen || !next.is_delta();
        sees = next.is_delta() ? would_see_by_delta() : would_see_by_gloss(vertex);
        ++sees_after;
        sees_by_gloss = !next.is_delta();
        is_first_glossy = would_be_first_glossy(vertex);
        has_glossy = has_glossy || is_first_glossy;
    }
};

// The state that the technique wants.
template <class Technique>
concept LooksBehindLinks = requires
{
    typename Technique::State;
};
template <class Technique>
struct StateOf {
    using Type = PathState;
};
template <LooksBehindLinks Technique>
struct StateOf<Technique> {
    using Type = typename Technique::State;
};

// Whether emitters and environments are not there for the path's last ray.
template <class Technique>
bool sees_no_emitters(const Technique& technique, const PathState& path)
{
    if constexpr (requires { technique.hides_emitters(); })
        return path.is_view && technique.hides_emitters();
    else
        return false;
}

// Integrator::bias() of a loop that ends paths at max_depth; negative: none.
std::string bias_of_depth(int max_depth);

// Surfaces that light may pass on its way to a vertex, where they count as bounces.
inline int passes_left(int max_depth, int bounces)
{
    return max_depth < 0 ? std::numeric_limits<int>::max() : max_depth - bounces - 1;
}

// For the first surfaces, and for `renderer replay`.
void note_scatter(Tracer& tracer, const PathState& path, const BsdfSample& next);
void note_roulette(Tracer& tracer, float survival, bool survived);

// For layers of parts of the light: what emission makes of the sum, and what direct light does, whose notes are those from
// number `first` on.
void note_emission(Tracer& tracer, const PathState& path, int depth, const Color& sum,
                   const std::optional<SurfacePoint>& hit);
void note_direct(Tracer& tracer, const PathState& path, int depth, const Color& before, std::size_t first);

template <class Technique>
float weight_behind_links(const Technique& technique, const typename StateOf<Technique>::Type& path)
{
    if constexpr (LooksBehindLinks<Technique>)
        return technique.chain_weight(path, 0);
    else
        return 1.f;
}

// What the path's last ray sees, if the technique counts it.
template <class Technique>
Color emitted(const Technique& technique, Tracer& tracer, const typename StateOf<Technique>::Type& path,
              const Ray& ray, const std::optional<SurfacePoint>& hit)
{
    if constexpr (requires { Technique::sees_only_lamps; }) {
        if (!hit) return Color(0.f);
    } else if (tracer.looks() > 0 && path.sees && hit) [[unlikely]] {
        return Color(0.f);
    }
    if ((hit && !hit->emitter) || !technique.counts_emission(path) || sees_no_emitters(technique, path))
        return Color(0.f);
    const EmitterValue light = tracer.scene().emission(path.receiver, ray.direction, hit ? &*hit : nullptr);
    if (light.radiance.is_black()) return Color(0.f);
    const float weight = (path.delta ? 1.f : technique.emission_weight(path, light.pdf)) *
                         weight_behind_links(technique, path);
    const Color contribution = path.throughput * light.radiance * weight;
    if (tracer.logging()) tracer.log_contribution(PathEvent::Kind::emission, "emission", contribution);
    return contribution;
}

// The same for what technique.direct() finds.
template <class Technique>
Color scattered(const Technique& technique, Tracer& tracer, Sampler& sampler,
                const typename StateOf<Technique>::Type& path, const Vertex& vertex)
{
    Color found;
    const std::size_t noted = tracer.noted_light();
    if constexpr (requires { technique.direct(tracer, sampler, path, vertex); })
        found = technique.direct(tracer, sampler, path, vertex);
    else
        found = technique.direct(tracer, sampler, vertex);
    if constexpr (LooksBehindLinks<Technique>) {
        if (vertex.is_shiny() && !found.is_black()) {
            const float weight = technique.chain_weight(path, 1);
            found *= weight;
            tracer.change_noted_light(noted, [weight](const Color& sum) { return sum * weight; });
        }
    }
    const Color contribution = path.throughput * found;
    if (tracer.logging() && !contribution.is_black())
        tracer.log_contribution(PathEvent::Kind::direct, "direct light", contribution);
    return contribution;
}

// Where chains have drawn numbers of the vertex, roulette has drawn its own before.
template <class Technique>
float number_of_roulette(const Technique&, Sampler& sampler, const typename StateOf<Technique>::Type& path)
{
    if constexpr (LooksBehindLinks<Technique>)
        return path.u_survival;
    else
        return sampler.next_1d();
}

// Russian roulette (Arvo and Kirk 1990): the path ends with some probability, and the survivors stand for the dead.
template <class Technique>
bool survives(const Technique& technique, Tracer& tracer, Sampler& sampler,
              typename StateOf<Technique>::Type& path, int bounces)
{
    const float survival = technique.survival(path, bounces);
    if (survival >= 1.f) return true;
    const bool survived = number_of_roulette(technique, sampler, path) < survival;
    if (survived) path.throughput /= survival;
    if (tracer.watched()) note_roulette(tracer, survival, survived);
    return survived;
}

template <class Technique>
Color follow_path(const Technique& technique, Tracer& tracer, Sampler& sampler,
                  typename StateOf<Technique>::Type& path, Ray ray)
{
    const auto end = [&](const char* why) {
        if (tracer.logging()) tracer.log(PathEvent::Kind::end, why);
    };
    const bool may_pass = tracer.scene().has_null_surfaces();
    Color result(0.f);
    int bounces = 0;
    for (int surfaces = 0;; ++surfaces) {
        const RayKind kind = surfaces == 0 ? RayKind::camera : RayKind::bounce;
        const auto hit = sees_no_emitters(technique, path) ? tracer.intersect_behind_emitters(ray, kind)
                                                           : tracer.intersect(ray, kind);
        result += emitted(technique, tracer, path, ray, hit);
        if (tracer.light_notes()) [[unlikely]]
            note_emission(tracer, path, bounces, result, hit);
        if (!hit) return end("the path has left the scene"), result;
        if (hit->emitter && tracer.scene().emitters_absorb())
            return end("an emitter absorbs the path"), result;
        const bool passes_only = bounces == technique.max_depth();
        if (passes_only &&
            (!may_pass || technique.counts_passes() || !hit->bsdf->lobes().has_any(Lobe::null)))
            return end("the path has its largest depth"), result;

        sampler.start_vertex(surfaces);
        Vertex vertex(*hit, ray.direction);
        if constexpr (requires { technique.sky_at(vertex); }) vertex.know_sky(technique.sky_at(vertex));
        // The next direction before the shadow ray: the processor works on both at once.
        const std::optional<BsdfSample> next = technique.scatter(sampler, vertex);
        if (may_pass && technique.counts_passes())
            tracer.limit_passes(passes_left(technique.max_depth(), bounces));
        if (!passes_only) {
            if constexpr (LooksBehindLinks<Technique>)
                result = technique.with_waiting(tracer, path, bounces, result);
            const std::size_t noted = tracer.noted_light();
            const Color before = result;
            result += scattered(technique, tracer, sampler, path, vertex);
            if (tracer.light_notes()) [[unlikely]]
                note_direct(tracer, path, bounces + 1, before, noted);
            if constexpr (LooksBehindLinks<Technique>)
                technique.find_chains(tracer, sampler, path, vertex, bounces);
        }
        if (!next) return end("the surface absorbs the path"), result;
        if (may_pass && next->is_pass()) {
            path.pass(*next);
            if (tracer.watched()) note_scatter(tracer, path, *next);
            bounces += technique.counts_passes() ? 1 : 0;
            ray = hit->spawn_ray(ray.direction); // of which rounding must not make another
            continue;
        }
        if (passes_only) return end("the path has its largest depth"), result;
        path.extend(vertex, *next);
        if (tracer.watched()) note_scatter(tracer, path, *next);
        if (path.throughput.is_black()) return end("the throughput of the path is zero"), result;
        ++bounces;
        const bool last = bounces == technique.max_depth();
        if (last && !technique.counts_emission(path)) return end("nothing else can contribute"), result;
        if (!survives(technique, tracer, sampler, path, bounces)) return end("roulette"), result;
        ray = hit->spawn_ray(vertex.to_world(*next));
    }
}

// Contributions are added in the order of their depths: so an image of less depth is a part of the sum.
template <class Technique>
Color trace_path(const Technique& technique, Tracer& tracer, Sampler& sampler, const Ray& ray)
{
    typename StateOf<Technique>::Type path(ray.origin);
    Color result = follow_path(technique, tracer, sampler, path, ray);
    if constexpr (LooksBehindLinks<Technique>)
        result = technique.with_waiting(tracer, path, std::numeric_limits<int>::max(), result);
    return result;
}

} // namespace plumb
