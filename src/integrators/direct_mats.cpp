// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "interfaces/plugin.h"
#include "plumb/integrator.h"

namespace plumb {

/// Emission and direct light, by BSDF sampling: one direction, and the emitter that it meets.
///
/// Point and directional lights, which no direction meets, are sampled directly. No parameters.
///
///         <integrator type="direct_mats"/>
class DirectMats final : public Integrator {
public:
    explicit DirectMats(const Params&) {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return estimator_.radiance(tracer, sampler, ray);
    }

    std::string bias() const override { return bias_of_depth(estimator_.max_depth()); }

private:
    PathEstimator estimator_ = PathEstimator::direct_light(PathEstimator::Finder::path);
};

template std::unique_ptr<Integrator> build<DirectMats>(const Params&);

} // namespace plumb
