// SPDX-License-Identifier: MIT

// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2

#include "integrators/guided_path.h"

#include "integrators/caustic_photons.h"
#include "integrators/spread_points.h"
#include "samplers/stream.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace plumb {

Color GuidedPath::radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const
{
    return trace_path(*this, tracer, sampler, ray);
}

// Of the BSDF's direction from the last vertex that was no link, against the guide's.
float GuidedPath::chain_weight(const GuidedPathState& path, int more_links) const
{
    const int links = path.chain + more_links;
    if (!path.cell || links == 0 || links > longest_chain) return 1.f;
    return mis_weight(heuristic(), path.pdf_of_direction,
                      path.directions * path.cell->pdf(path.position, path.direction)); // [1]
}

Color GuidedPath::with_waiting(Tracer& tracer, GuidedPathState& path, int depth, Color sum) const
{
    if (path.waiting.empty()) return sum;
    auto next = path.waiting.begin();
    for (; next != path.waiting.end() && next->depth <= depth; ++next) {
        sum += next->contribution;
        if (tracer.light_notes()) [[unlikely]]
            tracer.light_notes()->add({sum, next->by, next->emitter, next->depth});
    }
    path.waiting.erase(path.waiting.begin(), next);
    return sum;
}

void GuidedPath::find_chains(Tracer& tracer, Sampler& sampler, GuidedPathState& path, const Vertex& vertex,
                             int bounces) const
{
    // As many numbers are drawn whatever the chain does, and the rest of the path draws what it would draw without a guide.
    path.u_survival = sampler.next_1d();
    path.cell_here = vertex.has_diffuse_lobes() ? guide_->cell_at(vertex.at().position) : nullptr;
    if (!path.cell_here) return;
    const float u_chance = sampler.next_1d();
    const Vec2f u_direction = sampler.next_2d();
    const auto key = static_cast<std::uint64_t>(sampler.next_choice() * 0x1p53);
    // Throughput has no bound where surfaces reflect more than they receive.
    const float worth = std::min(GuideCell::most_directions, max_component(path.throughput) * path.eta_scale *
                                                                 path.cell_here->strength());
    path.directions_here = worth < 1.f ? worth : std::round(worth);
    if (max_depth() - bounces == 1) return; // light sampling finds what is one bounce away
    const int count = worth < 1.f ? (u_chance < worth ? 1 : 0) : static_cast<int>(path.directions_here);
    const float first = worth < 1.f ? u_chance / worth : u_chance; // uniform again
    for (int i = 0; i < count; ++i) {
        const float u_choice = (first + static_cast<float>(i)) / static_cast<float>(count);
        const auto guided = path.cell_here->sample(
            vertex.at().position, std::min(u_choice, one_minus_epsilon), shifted(u_direction, i));
        if (!guided) continue;
        const BsdfValue value = vertex.evaluate(guided->direction);
        if (value.f_cos.is_black()) continue;
        if (tracer.logging())
            tracer.log(
                PathEvent::Kind::direct,
                fmt::format("a guided direction: pdf {:.6g}, of the BSDF {:.6g}", guided->pdf, value.pdf));
        const float density = path.directions_here * guided->pdf;
        const float weight = mis_weight(heuristic(), density, value.pdf); // [1]
        PathState chain = path;
        chain.extend(vertex, {guided->direction, value.f_cos * (weight / density), density});
        follow(tracer, path,
               {chain, vertex.at().spawn_ray(guided->direction), bounces + 1,
                key + static_cast<std::uint64_t>(i)});
    }
}

void GuidedPath::follow(Tracer& tracer, GuidedPathState& path, Chain chain) const
{
    const Scene& scene = tracer.scene();
    StreamSampler sampler(chain.key);
    for (int length = 0;;) {
        const auto hit = tracer.intersect(chain.ray, RayKind::bounce);
        if (length > 0 && (!hit || hit->emitter)) {
            const EmitterValue light =
                scene.emission(chain.path.receiver, chain.ray.direction, hit ? &*hit : nullptr);
            const float weight = chain.path.delta ? 1.f : emission_weight(chain.path, light.pdf);
            const Color contribution = chain.path.throughput * light.radiance * weight;
            if (!contribution.is_black()) {
                if (tracer.logging())
                    tracer.log_contribution(PathEvent::Kind::emission, "emission", contribution);
                path.wait({chain.depth, FoundBy::direction, hit ? hit->emitter_index : environment_index,
                           contribution});
            }
        }
        if (!hit || (hit->emitter && scene.emitters_absorb())) return;
        Vertex vertex(*hit, chain.ray.direction);
        const bool passes_only = chain.depth == max_depth() || length == longest_chain;
        if (!(vertex.has_delta_lobes() || vertex.is_shiny()) || (passes_only && !scene.has_null_surfaces()))
            return;
        const std::optional<BsdfSample> next = scatter(sampler, vertex);
        if (!passes_only && vertex.is_shiny()) {
            vertex.know_sky(sky_at(vertex));
            find_direct(tracer, sampler, path, chain, vertex);
        }
        if (!next || !vertex.is_link(*next)) return;
        if (next->is_pass()) {
            chain.path.pass(*next);
            if (counts_passes() && chain.depth++ == max_depth()) return;
            chain.ray = hit->spawn_ray(chain.ray.direction);
            continue;
        }
        if (passes_only) return;
        ++length;
        ++chain.depth;
        chain.path.extend(vertex, *next);
        chain.ray = hit->spawn_ray(vertex.to_world(*next));
    }
}

void GuidedPath::find_direct(Tracer& tracer, Sampler& sampler, GuidedPathState& path, const Chain& chain,
                             const Vertex& vertex) const
{
    if (tracer.scene().has_null_surfaces() && counts_passes())
        tracer.limit_passes(passes_left(max_depth(), chain.depth));
    const std::size_t noted = tracer.noted_light();
    const Color contribution = chain.path.throughput * direct(tracer, sampler, chain.path, vertex);
    std::uint32_t emitter = environment_index;
    if (tracer.light_notes()) [[unlikely]]
        emitter = tracer.light_notes()->take_back(noted).value_or(emitter);
    if (contribution.is_black()) return;
    if (tracer.logging()) tracer.log_contribution(PathEvent::Kind::direct, "direct light", contribution);
    path.wait({chain.depth + 1, FoundBy::emitter_sample, emitter, contribution});
}

} // namespace plumb
