// SPDX-License-Identifier: MIT

// [1] Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2

#include "integrators/path_estimator.h"
#include "model/plugin.h"

namespace plumb {

/// All light, by paths that find emitters in two ways: one emitter sample at each surface, and the path itself.
///
/// Both are weighted by multiple importance sampling (Veach 1997, section 9.2), so each does what it is good at. What
/// only one of them can find (point lights; what is seen after a delta bounce) has weight 1. The integrator to
/// use when in doubt.
///
///     maxDepth    integer   surface bounces: 0 shows emitters only, 1 direct light, -1 everything   (default -1)
///     rrDepth     integer   bounces before Russian roulette starts   (default 3)
///     countPasses   boolean   whether passing straight through a mask costs a bounce, of shadow rays as well   (default false)
///     hideEmitters   boolean   the camera sees through surfaces that emit, and no environment; mirrors show them
///                              (default false)
///     heuristic   string    how the two share: power or balance   (default power)
///     candidates  integer   emitter samples at the first glossy surface of a path; one of them is followed, chosen by what it
///                           would add if nothing were in the way   (default 4)
///
///         <integrator type="path_mis">
///             <string name="heuristic" value="balance"/>
///         </integrator>
class PathMis final : public EstimatorIntegrator {
public:
    explicit PathMis(const Params& params)
        : EstimatorIntegrator(
              PathEstimator(PathEstimator::LightStrategy::both, PathLimits(params), heuristic_of(params),
                            static_cast<int>(params.integer("candidates", 4, Range::closed(1, 64)))))
    {}
};

template std::unique_ptr<Integrator> build<PathMis>(const Params&);

} // namespace plumb
