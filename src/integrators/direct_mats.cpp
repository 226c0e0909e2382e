// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "model/plugin.h"

namespace plumb {

/// Emission and direct light, by BSDF sampling: one direction, and the emitter that it meets.
///
/// Point and directional lights, which no direction meets, are sampled directly. No parameters.
///
///         <integrator type="direct_mats"/>
class DirectMats final : public EstimatorIntegrator {
public:
    explicit DirectMats(const Params&)
        : EstimatorIntegrator(PathEstimator::direct_light(PathEstimator::LightStrategy::path))
    {}
};

template std::unique_ptr<Integrator> build<DirectMats>(const Params&);

} // namespace plumb
