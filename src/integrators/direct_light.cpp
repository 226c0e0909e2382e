// SPDX-License-Identifier: MIT

// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2

#include "integrators/direct_light.h"

#include "integrators/spread_points.h"
#include "plumb/base/error.h"

#include <fmt/format.h>

namespace plumb {
namespace {

Color light_from(Tracer& tracer, Sampler& sampler, const Vertex& vertex, const Emitter& emitter,
                 Measure measure)
{
    const double u_select = sampler.next_choice();
    const Vec2f u = sampler.next_2d();
    const auto light = emitter.sample(vertex.receiver(), u_select, u, measure);
    if (!light) return Color(0.f);
    return light_through(tracer, vertex, *light, vertex.evaluate(light->wi).f_cos);
}

// Of one of so many emitter samples, against BSDF samples of density bsdf_pdf ([1]).
float weight_of(const EmitterSample& light, Heuristic heuristic, float samples, float bsdf_pdf,
                float directions)
{
    if (light.is_delta) return 1.f;
    const float looking = light.distance == infinity ? 1.f : directions;
    return mis_weight(heuristic, samples * light.pdf, looking * bsdf_pdf);
}

} // namespace

Heuristic heuristic_of(const Params& params)
{
    return params.choice("heuristic", "power", {"balance", "power"}) == "balance" ? Heuristic::balance
                                                                                  : Heuristic::power;
}

float mis_weight(Heuristic heuristic, float mine, float other)
{
    switch (heuristic) {
    case Heuristic::none: return 1.f;
    case Heuristic::balance: return balance_heuristic(mine, other);
    case Heuristic::power: return power_heuristic(mine, other);
    }
    return 1.f;
}

Color light_through(Tracer& tracer, const Vertex& vertex, const EmitterSample& light, Color f_cos,
                    float weight)
{
    const Color contribution = f_cos * light.radiance * (weight / light.pdf);
    if (contribution.is_black()) return contribution;
    const float visible = tracer.visible(vertex.at(), light);
    if (visible > 0.f) return contribution * visible;
    if (tracer.logging())
        tracer.log(PathEvent::Kind::direct,
                   fmt::format("a light at distance {:.6g} is hidden", light.distance));
    return Color(0.f);
}

Color light_from_one_emitter(Tracer& tracer, Sampler& sampler, const Vertex& vertex, Heuristic heuristic,
                             float directions)
{
    if (!vertex.has_smooth_lobes()) return Color(0.f);
    const double u_choice = sampler.next_choice();
    const Vec2f u = sampler.next_2d();
    const auto light = tracer.scene().sample_emitter(vertex.receiver(), u_choice, u);
    if (!light) return Color(0.f);
    const BsdfValue value = vertex.evaluate(light->wi);
    const float weight = weight_of(*light, heuristic, 1.f, value.pdf, directions);
    const Color found = light_through(tracer, vertex, *light, value.f_cos, weight);
    tracer.note_light(found, FoundBy::emitter_sample, light->emitter_index);
    return found;
}

Color light_by_resampling(Tracer& tracer, Sampler& sampler, const Vertex& vertex, Heuristic heuristic,
                          int candidates, float directions)
{
    if (!vertex.has_smooth_lobes()) return Color(0.f);
    const double u_choice = sampler.next_choice();
    const Vec2f u = sampler.next_2d();
    float u_pick = sampler.next_1d();
    const LightReceiver receiver = vertex.receiver();
    const auto count = static_cast<float>(candidates);
    std::optional<EmitterSample> picked;
    Color f_cos;
    float sum = 0.f;
    for (int i = 0; i < candidates; ++i) {
        const double choice_i = wrapped(u_choice + static_cast<double>(i) / candidates);
        const auto light = tracer.scene().sample_emitter(receiver, choice_i, shifted(u, i));
        if (!light) continue;
        const BsdfValue value = vertex.evaluate(light->wi);
        const float brightness = luminance(value.f_cos * light->radiance);
        const float mis = weight_of(*light, heuristic, count, value.pdf, directions);
        const float share = brightness * mis / light->pdf;
        if (!(share > 0.f)) continue;
        sum += share;
        const float chance = share / sum;
        if (u_pick < chance) {
            u_pick = std::min(u_pick / chance, one_minus_epsilon);
            picked = light;
            picked->pdf = brightness; // in proportion to which it is as if it had been sampled
            f_cos = value.f_cos;
        } else {
            u_pick = std::min((u_pick - chance) / (1.f - chance), one_minus_epsilon);
        }
    }
    if (!picked) return Color(0.f);
    picked->pdf *= count / sum;
    const Color found = light_through(tracer, vertex, *picked, f_cos);
    tracer.note_light(found, FoundBy::emitter_sample, picked->emitter_index);
    return found;
}

Color light_from_one_delta_emitter(Tracer& tracer, Sampler& sampler, const Vertex& vertex)
{
    if (!tracer.scene().has_delta_emitters() || !vertex.has_smooth_lobes()) return Color(0.f);
    const double u_choice = sampler.next_choice();
    const Vec2f u = sampler.next_2d();
    const auto light = tracer.scene().sample_delta_emitter(vertex.receiver(), u_choice, u);
    if (!light) return Color(0.f);
    const Color found = light_through(tracer, vertex, *light, vertex.evaluate(light->wi).f_cos);
    tracer.note_light(found, FoundBy::emitter_sample, light->emitter_index);
    return found;
}

Color light_from_all_emitters(Tracer& tracer, Sampler& sampler, const Vertex& vertex, Measure measure)
{
    Color sum(0.f);
    if (!vertex.has_smooth_lobes()) return sum;
    std::uint32_t index = 0;
    for (const Emitter* emitter : tracer.scene().emitters()) {
        sum += light_from(tracer, sampler, vertex, *emitter, measure);
        tracer.note_light(sum, FoundBy::emitter_sample, index++);
    }
    return sum;
}

Color light_from_all_delta_emitters(Tracer& tracer, Sampler& sampler, const Vertex& vertex)
{
    Color sum(0.f);
    if (!vertex.has_smooth_lobes()) return sum;
    std::uint32_t index = 0;
    for (const Emitter* emitter : tracer.scene().emitters()) {
        if (emitter->is_delta()) {
            sum += light_from(tracer, sampler, vertex, *emitter, Measure::best);
            tracer.note_light(sum, FoundBy::emitter_sample, index);
        }
        ++index;
    }
    return sum;
}

Color light_along(Tracer& tracer, const Vertex& vertex, const std::optional<BsdfSample>& sampled)
{
    if (!sampled || sampled->is_delta() || sampled->weight.is_black()) return Color(0.f);
    Color radiance(0.f);
    look_along(tracer, vertex, vertex.to_world(*sampled), [&](const SurfacePoint* at, const Color& emission) {
        radiance += emission;
        tracer.note_light(sampled->weight * radiance, FoundBy::direction,
                          at ? at->emitter_index : environment_index);
    });
    return sampled->weight * radiance;
}

void require_solid_angle(const Scene& scene, const char* parameter)
{
    for (const Emitter* emitter : scene.emitters()) {
        if (emitter->has_solid_angle()) continue;
        std::string name = "an emitter";
        for (const SceneObject& object : scene.objects())
            if (object.emitter.get() == emitter) name = object.name;
        throw Error(fmt::format("{} cannot be 'solid-angle': the light of {} can only be sampled by area; "
                                "use 'area'",
                                parameter, name));
    }
}

} // namespace plumb
