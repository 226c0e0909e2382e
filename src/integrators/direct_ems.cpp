// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "interfaces/plugin.h"

namespace plumb {

/// Emission and direct light, by emitter sampling: one sample of one emitter, chosen by what it is
/// expected to send to the surface.
///
/// Emitters reflected by delta BSDFs (mirror, smooth glass) are seen too, so that all direct_* integrators agree.
/// No parameters.
///
///         <integrator type="direct_ems"/>
class DirectEms final : public EstimatorIntegrator {
public:
    explicit DirectEms(const Params&)
        : EstimatorIntegrator(PathEstimator::direct_light(PathEstimator::Finder::emitter_samples))
    {}
};

template std::unique_ptr<Integrator> build<DirectEms>(const Params&);

} // namespace plumb
