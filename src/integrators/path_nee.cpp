// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "model/plugin.h"

namespace plumb {

/// All light, by paths with next-event estimation: one sample of one emitter at each surface.
///
/// Emitters are chosen by what they are expected to send to the surface. What the path itself meets counts only where
/// no emitter sample could have found it: at the first hit, and after a delta bounce (mirror, smooth glass).
///
///     maxDepth   integer   surface bounces: 0 shows emitters only, 1 direct light, -1 everything   (default -1)
///     rrDepth    integer   bounces before Russian roulette starts   (default 1)
///     countPasses   boolean   whether passing straight through a mask costs a bounce, of shadow rays as well   (default false)
///     hideEmitters   boolean   the camera sees through surfaces that emit, and no environment; mirrors show them
///                              (default false)
///
///         <integrator type="path_nee"/>
class PathNee final : public EstimatorIntegrator {
public:
    explicit PathNee(const Params& params)
        : EstimatorIntegrator(
              PathEstimator(PathEstimator::LightStrategy::emitter_samples, PathLimits(params)))
    {}
};

template std::unique_ptr<Integrator> build<PathNee>(const Params&);

} // namespace plumb
