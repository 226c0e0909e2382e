// SPDX-License-Identifier: MIT
#pragma once

// Integrator::look() of a path tracer: its paths as long as they see lamps (PathState::sees), and of their light only that.

#include "integrators/path_estimator.h"

namespace plumb {

class LookPath {
public:
    // The estimator must live as long. looks: how many there are of each sample.
    LookPath(const PathEstimator& estimator, int looks) : estimator_(estimator), looks_(looks) {}

    Color look(Tracer& tracer, Sampler& sampler, const Ray& ray) const
    {
        return trace_path(*this, tracer, sampler, ray);
    }

    // The technique that path_loop.h asks for.
    static constexpr bool sees_only_lamps = true;
    int max_depth() const { return estimator_.max_depth(); }
    bool counts_passes() const { return estimator_.counts_passes(); }
    bool counts_emission(const PathState& path) const
    {
        return path.sees && estimator_.counts_emission(path);
    }
    float emission_weight(const PathState& path, float light_pdf) const
    {
        return estimator_.weight_of_look(path, light_pdf, looks_);
    }
    Color direct(Tracer&, Sampler&, const Vertex&) const { return Color(0.f); }
    std::optional<BsdfSample> scatter(Sampler& sampler, const Vertex& vertex) const
    {
        const bool may_see = vertex.is_glossy() || vertex.has_delta_lobes();
        return may_see ? estimator_.scatter(sampler, vertex) : std::nullopt;
    }
    // No roulette: what sees goes on.
    float survival(const PathState& path, int) const { return path.sees ? 1.f : 0.f; }

private:
    const PathEstimator& estimator_;
    int looks_;
};

} // namespace plumb
