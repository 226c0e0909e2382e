// SPDX-License-Identifier: MIT

// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2

#include "integrators/guided_path.h"

#include "integrators/caustic_photons.h"

#include <fmt/format.h>

namespace plumb {

Color GuidedPath::radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const
{
    return trace_path(*this, tracer, sampler, ray);
}

float GuidedPath::chain_weight(const GuidedPathState& path) const
{
    if (!path.cell || path.chain > longest_chain) return 1.f;
    return mis_weight(heuristic(), path.pdf_of_direction,
                      path.chance * path.cell->pdf(path.position, path.direction));
}

// What a chain finds is counted where it meets it.
Color GuidedPath::with_chains(Tracer& tracer, Sampler& sampler, GuidedPathState& path, const Vertex& vertex,
                              int bounces, const Color& before) const
{
    path.cell_here = vertex.has_smooth_lobes() ? guide_->cell_at(vertex.at().position) : nullptr;
    if (!path.cell_here || max_depth() - bounces == 1)
        return before; // light sampling finds what is one bounce away
    path.chance_here =
        std::min(1.f, max_component(path.throughput) * path.eta_scale * path.cell_here->strength());
    const float u_chance = sampler.next_1d();
    const Vec2f u_direction = sampler.next_2d();
    if (!(u_chance < path.chance_here)) return before;
    const float u_choice = std::min(u_chance / path.chance_here, one_minus_epsilon); // uniform again
    const auto guided = path.cell_here->sample(vertex.at().position, u_choice, u_direction);
    if (!guided) return before;
    const BsdfValue value = vertex.evaluate(guided->direction);
    if (value.f_cos.is_black()) return before;
    if (tracer.logging())
        tracer.log(PathEvent::Kind::direct,
                   fmt::format("a guided direction: pdf {:.6g}, of the BSDF {:.6g}", guided->pdf, value.pdf));
    const float density = path.chance_here * guided->pdf;
    const float weight = mis_weight(heuristic(), density, value.pdf); // [1]
    const Chain chain{vertex.at().spawn_ray(guided->direction),
                      path.throughput * value.f_cos * (weight / density), vertex.receiver(), bounces + 1};
    return follow(tracer, sampler, chain, before);
}

Color GuidedPath::follow(Tracer& tracer, Sampler& sampler, Chain chain, Color sum) const
{
    const Scene& scene = tracer.scene();
    for (int length = 0;;) {
        const auto hit = tracer.intersect(chain.ray, RayKind::bounce);
        if (length > 0 && (!hit || hit->emitter)) {
            const Color contribution =
                chain.throughput *
                scene.emission(chain.receiver, chain.ray.direction, hit ? &*hit : nullptr).radiance;
            if (tracer.logging() && !contribution.is_black())
                tracer.log_contribution(PathEvent::Kind::emission, "emission", contribution);
            sum += contribution;
            if (tracer.light_notes()) [[unlikely]]
                tracer.light_notes()->add(
                    {sum, FoundBy::direction, hit ? hit->emitter_index : environment_index, chain.depth});
        }
        if (!hit || (hit->emitter && scene.emitters_absorb())) return sum;
        const Vertex vertex(*hit, chain.ray.direction);
        const bool passes_only = chain.depth == max_depth() || length == longest_chain;
        if (!vertex.has_delta_lobes() || (passes_only && !scene.has_null_surfaces())) return sum;
        const float u_lobe = sampler.next_1d();
        const Vec2f u = sampler.next_2d();
        const std::optional<BsdfSample> next = vertex.sample(u_lobe, u);
        if (!next || !next->is_delta()) return sum;
        chain.throughput *= next->weight;
        if (next->is_pass()) {
            if (counts_passes() && chain.depth++ == max_depth()) return sum;
            chain.ray = hit->spawn_ray(chain.ray.direction);
            continue;
        }
        if (passes_only) return sum;
        ++length;
        ++chain.depth;
        chain.receiver = vertex.receiver();
        chain.ray = hit->spawn_ray(vertex.to_world(*next));
    }
}

} // namespace plumb
