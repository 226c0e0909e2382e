// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "interfaces/plugin.h"
#include "plumb/integrator.h"

namespace plumb {

/// Emission and direct light, by one emitter sample and one BSDF sample, weighted by the power heuristic.
///
/// No parameters; direct-mis has some.
///
///         <integrator type="direct_mis"/>
class DirectMis final : public Integrator {
public:
    explicit DirectMis(const Params&) {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return estimator_.radiance(tracer, sampler, ray);
    }

    std::string bias() const override { return bias_of_depth(estimator_.max_depth()); }

private:
    PathEstimator estimator_ = PathEstimator::direct_light(PathEstimator::Finder::both);
};

template std::unique_ptr<Integrator> build<DirectMis>(const Params&);

} // namespace plumb
