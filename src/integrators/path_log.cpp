// SPDX-License-Identifier: MIT

#include "integrators/path_loop.h"

#include <fmt/format.h>

namespace plumb {
namespace {

const char* name_of(Lobe lobe)
{
    switch (lobe) {
    case Lobe::diffuse_reflection: return "diffuse reflection";
    case Lobe::glossy_reflection: return "glossy reflection";
    case Lobe::glossy_transmission: return "glossy transmission";
    case Lobe::delta_reflection: return "delta reflection";
    case Lobe::delta_transmission: return "delta transmission";
    case Lobe::null: return "pass";
    }
    return "";
}

std::string text(const Color& c)
{
    return fmt::format("({:.6g} {:.6g} {:.6g})", c.r, c.g, c.b);
}

} // namespace

std::string bias_of_depth(int max_depth)
{
    if (max_depth < 0) return "";
    if (max_depth == 0) return "all light except emission is omitted";
    return fmt::format("light of more than {} surface bounce{} is omitted", max_depth,
                       max_depth == 1 ? "" : "s");
}

void note_scatter(Tracer& tracer, const PathState& path, const BsdfSample& next)
{
    if (FirstSurfaces* const first = tracer.first_surfaces()) first->scatter(next.weight * sqr(next.eta));
    if (!tracer.logging()) return;
    tracer.log(PathEvent::Kind::scatter,
               fmt::format("{}: weight {}, {} {:.6g}, eta {:.6g}; throughput {}", name_of(next.lobe),
                           text(next.weight), next.is_delta() ? "probability" : "pdf", next.pdf, next.eta,
                           text(path.throughput)));
}

void note_emission(Tracer& tracer, const PathState& path, int depth, const Color& sum,
                   const std::optional<SurfacePoint>& hit)
{
    if (hit && !hit->emitter) return;
    const FoundBy by = path.is_chosen ? FoundBy::direction : FoundBy::view;
    tracer.light_notes()->add({sum, by, hit ? hit->emitter_index : environment_index, depth});
}

void note_direct(Tracer& tracer, const PathState& path, int depth, const Color& before, std::size_t first)
{
    tracer.light_notes()->change_sums(first,
                                      [&](const Color& direct) { return before + path.throughput * direct; });
    tracer.light_notes()->set_depth(first, depth);
}

void note_roulette(Tracer& tracer, float survival, bool survived)
{
    if (FirstSurfaces* const first = tracer.first_surfaces(); first && survived)
        first->scatter(Color(1.f / survival));
    if (!tracer.logging()) return;
    tracer.log(PathEvent::Kind::roulette, fmt::format("{} with probability {:.6g}",
                                                      survived ? "survives" : "does not survive", survival));
}

} // namespace plumb
