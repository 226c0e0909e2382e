// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "model/plugin.h"

namespace plumb {

/// Emission and direct light, by one emitter sample and one BSDF sample, weighted by the power heuristic.
///
/// No parameters; direct-mis has some.
///
///         <integrator type="direct_mis"/>
class DirectMis final : public EstimatorIntegrator {
public:
    explicit DirectMis(const Params&)
        : EstimatorIntegrator(PathEstimator::direct_light(PathEstimator::LightStrategy::both))
    {}
};

template std::unique_ptr<Integrator> build<DirectMis>(const Params&);

} // namespace plumb
