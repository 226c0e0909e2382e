// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "interfaces/plugin.h"
#include "plumb/integrator.h"

namespace plumb {

/// All light, by paths that follow the BSDFs: `path` under the name that the EPFL and ETH courses use.
///
///     maxDepth   integer   surface bounces: 0 shows emitters only, 1 direct light, -1 everything   (default -1)
///     rrDepth    integer   bounces before Russian roulette starts   (default 3)
///
///         <integrator type="path_mats"/>
class PathMats final : public Integrator {
public:
    explicit PathMats(const Params& params) : estimator_(PathEstimator::Finder::path, PathLimits(params)) {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return estimator_.radiance(tracer, sampler, ray);
    }

    std::string bias() const override { return bias_of_depth(estimator_.max_depth()); }

private:
    PathEstimator estimator_;
};

template std::unique_ptr<Integrator> build<PathMats>(const Params&);

} // namespace plumb
