// SPDX-License-Identifier: MIT
#pragma once

// The path tracer whose every choice is a parameter: implicit or explicit, its measures, warps and termination.

#include "integrators/direct_light.h"
#include "integrators/hemisphere_warp.h"
#include "integrators/path_estimator.h"

namespace plumb {

class ConfiguredPath {
public:
    // Whether the file gave one of the parameters that only this path tracer has.
    static bool is_asked_for(const Params& params);

    explicit ConfiguredPath(const Params& params);
    void prepare(const Scene& scene) const; // throws Error if direct-measure does not suit the scene's lights
    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const;
    std::string bias() const { return bias_of_depth(max_depth()); } // as of Integrator

    // The technique that path_loop.h asks for.
    int max_depth() const { return limits_.max_depth; }
    bool counts_emission(const PathState& path) const { return !explicit_ || path.delta; }
    float emission_weight(const PathState&, float) const { return 1.f; }
    Color direct(Tracer& tracer, Sampler& sampler, const Vertex& vertex) const;
    std::optional<BsdfSample> scatter(Sampler& sampler, const Vertex& vertex) const;
    float survival(const PathState& path, int bounces) const;

private:
    // How explicit mode chooses directions towards emitters.
    enum class DirectMeasure { best, area, solid_angle, hemisphere };
    static DirectMeasure direct_measure(const Params& params, bool is_explicit);
    void read_termination(const Params& params);
    float read_bounces(const Params& params) const;

    bool explicit_;
    PathLimits limits_;
    float termination_probability_ = 0.f; // after every bounce beyond limits_.roulette_depth
    DirectMeasure direct_measure_;
    HemisphereWarp direct_warp_;
    HemisphereWarp indirect_warp_;
};

} // namespace plumb
