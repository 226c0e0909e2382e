// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "model/plugin.h"

namespace plumb {

/// All light, by paths that follow the BSDFs: `path` under the name that the EPFL and ETH courses use.
///
///     maxDepth   integer   surface bounces: 0 shows emitters only, 1 direct light, -1 everything   (default -1)
///     rrDepth    integer   bounces before Russian roulette starts   (default 1)
///     countPasses   boolean   whether passing straight through a mask costs a bounce, of shadow rays as well   (default false)
///     hideEmitters   boolean   the camera sees through surfaces that emit, and no environment; mirrors show them
///                              (default false)
///
///         <integrator type="path_mats"/>
class PathMats final : public EstimatorIntegrator {
public:
    explicit PathMats(const Params& params)
        : EstimatorIntegrator(PathEstimator(PathEstimator::LightStrategy::path, PathLimits(params)))
    {}
};

template std::unique_ptr<Integrator> build<PathMats>(const Params&);

} // namespace plumb
