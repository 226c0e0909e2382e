// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"

namespace plumb {
namespace {

// However bright, a path ends some day; but not early: the survivors of a chain that loses nothing, inside glass say,
// would weigh more with each bounce.
constexpr int uncapped_bounces = 128;
constexpr float largest_survival = 0.99f;

// Paths of more throughput go on; others are as likely to as they have a part of it, and then have it. If survivors had all of their
// light again, the few of many bounces would weigh as much as the many of few.
constexpr float kept_throughput = 0.4f;

} // namespace

PathLimits::PathLimits(const Params& params)
{
    max_depth =
        static_cast<int>(params.integer("maxDepth", max_depth, Range::closed(-1, largest_path_depth)));
    roulette_depth =
        static_cast<int>(params.integer("rrDepth", roulette_depth, Range::closed(0, largest_path_depth)));
    count_passes = params.boolean("countPasses", count_passes);
    hide_emitters = params.boolean("hideEmitters", false);
}

PathEstimator PathEstimator::direct_light(LightStrategy finder)
{
    PathLimits one_bounce;
    one_bounce.max_depth = 1;
    return PathEstimator(finder, one_bounce);
}

Color PathEstimator::radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const
{
    return trace_path(*this, tracer, sampler, ray);
}

std::string PathEstimator::bias() const
{
    const std::string of_depth = bias_of_depth(limits_.max_depth);
    if (!limits_.hide_emitters) return of_depth;
    return (of_depth.empty() ? "" : of_depth + "; ") + "the camera does not see emitters";
}

Color PathEstimator::direct(Tracer& tracer, Sampler& sampler, const PathState& path,
                            const Vertex& vertex) const
{
    switch (strategy_) {
    case LightStrategy::path: return light_from_one_delta_emitter(tracer, sampler, vertex);
    case LightStrategy::emitter_samples: return light_from_one_emitter(tracer, sampler, vertex);
    case LightStrategy::both:
        const bool is_looked_from = tracer.looks() > 0 && path.would_see_by_gloss(vertex);
        const float directions = is_looked_from ? static_cast<float>(tracer.looks()) : 1.f;
        if (candidates_ > 1 && path.would_be_first_glossy(vertex))
            return light_by_resampling(tracer, sampler, vertex, heuristic_, candidates_, directions);
        return light_from_one_emitter(tracer, sampler, vertex, heuristic_, directions);
    }
    return Color(0.f);
}

float PathEstimator::survival(const PathState& path, int bounces) const
{
    if (bounces <= limits_.roulette_depth) return 1.f;
    return std::min(max_component(path.throughput) * path.eta_scale / kept_throughput,
                    bounces <= uncapped_bounces ? 1.f : largest_survival);
}

} // namespace plumb
