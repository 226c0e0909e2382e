// SPDX-License-Identifier: MIT

#include "integrators/configured_path.h"

#include <cmath>

#include <fmt/format.h>

namespace plumb {

bool ConfiguredPath::is_asked_for(const Params& params)
{
    bool asked = false; // all are looked up, so that a misspelt one can be told from them
    for (const char* name : {"isExplicit", "termination", "termination-param", "direct-measure",
                             "indirect-measure", "direct-warp", "indirect-warp", "nSamples"})
        asked = params.has(name) || asked;
    return asked;
}

ConfiguredPath::ConfiguredPath(const Params& params)
    : explicit_(params.boolean("isExplicit", false)),
      limits_(params),
      direct_measure_(direct_measure(params, explicit_)),
      direct_warp_(hemisphere_warp(params, "direct-warp")),
      indirect_warp_(hemisphere_warp(params, "indirect-warp"))
{
    params.choice("indirect-measure", "hemisphere", {"hemisphere"});
    if (params.integer("nSamples", 1) != 1)
        params.warn(
            "nSamples",
            "nSamples is not used: a path is one sample; the sampler's sampleCount sets their number");
    read_termination(params);
}

ConfiguredPath::DirectMeasure ConfiguredPath::direct_measure(const Params& params, bool is_explicit)
{
    const std::string word =
        params.choice("direct-measure", "none", {"solid-angle", "area", "hemisphere", "none"});
    if (word == "solid-angle") return DirectMeasure::solid_angle;
    if (word == "area") return DirectMeasure::area;
    if (word == "hemisphere") return DirectMeasure::hemisphere;
    if (is_explicit)
        params.warn("direct-measure", "explicit mode without a direct-measure samples each light by solid "
                                      "angle if possible, else by area");
    return DirectMeasure::best;
}

void ConfiguredPath::read_termination(const Params& params)
{
    if (!params.has("termination"))
        params.fail("termination", "must be given for this path tracer: 'max-depth' or 'russian-roulette'");
    const std::string termination =
        params.choice("termination", "max-depth", {"max-depth", "russian-roulette"});
    if (termination == "max-depth") {
        const float bounces = read_bounces(params);
        const bool is_deeper = limits_.max_depth >= 0 && static_cast<float>(limits_.max_depth) < bounces;
        if (!is_deeper) limits_.max_depth = static_cast<int>(bounces);
        if (params.has("rrDepth"))
            params.warn("rrDepth", "rrDepth is not used: with termination 'max-depth' there is no roulette");
        return;
    }
    if (!params.has("termination-param"))
        params.fail("termination-param",
                    "must be given for termination 'russian-roulette': the probability that "
                    "a path ends, in (0, 1)");
    termination_probability_ = params.number("termination-param", 0.5f, Range::open(0.0, 1.0));
    if (!params.has("rrDepth")) limits_.roulette_depth = 0;
}

float ConfiguredPath::read_bounces(const Params& params) const
{
    const float bounces = params.number("termination-param", 2.f, Range::closed(0.0, largest_path_depth));
    if (bounces == std::floor(bounces)) return bounces;
    params.fail(
        "termination-param",
        fmt::format("must be a whole number of bounces for termination 'max-depth', not {}", bounces));
    return 2.f;
}

void ConfiguredPath::prepare(const Scene& scene) const
{
    if (explicit_ && direct_measure_ == DirectMeasure::solid_angle)
        require_solid_angle(scene, "direct-measure");
}

Color ConfiguredPath::radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const
{
    return trace_path(*this, tracer, sampler, ray);
}

Color ConfiguredPath::direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const
{
    if (!explicit_) return light_from_all_delta_emitters(tracer, sampler, vertex);
    switch (direct_measure_) {
    case DirectMeasure::best: return light_from_all_emitters(tracer, sampler, vertex, Measure::best);
    case DirectMeasure::area: return light_from_all_emitters(tracer, sampler, vertex, Measure::area);
    case DirectMeasure::solid_angle:
        return light_from_all_emitters(tracer, sampler, vertex, Measure::solid_angle);
    case DirectMeasure::hemisphere: break;
    }
    if (!vertex.has_smooth_lobes()) return Color(0.f);
    const Color unreachable = light_from_all_delta_emitters(tracer, sampler, vertex);
    const auto sampled = scatter_by_warp(direct_warp_, sampler, vertex);
    const std::size_t noted = tracer.noted_light();
    const Color found = light_along(tracer, vertex, sampled);
    tracer.change_noted_light(noted, [&](const Color& sum) { return unreachable + sum; });
    return unreachable + found;
}

std::optional<BsdfSample> ConfiguredPath::scatter(Sampler& sampler, const Vertex& vertex) const
{
    return scatter_by_warp(indirect_warp_, sampler, vertex);
}

float ConfiguredPath::survival(const PathState&, int bounces) const
{
    return bounces > limits_.roulette_depth ? 1.f - termination_probability_ : 1.f;
}

} // namespace plumb
