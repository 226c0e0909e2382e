// SPDX-License-Identifier: MIT

#include "integrators/path_estimator.h"
#include "interfaces/plugin.h"
#include "plumb/integrator.h"

namespace plumb {

/// Emission and direct light, by emitter sampling: one sample of one emitter, chosen in proportion to power.
///
/// Emitters reflected by discrete BSDFs (mirror, smooth glass) are seen too, so that all direct_* integrators agree.
/// No parameters.
///
///         <integrator type="direct_ems"/>
class DirectEms final : public Integrator {
public:
    explicit DirectEms(const Params&) {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const override
    {
        return estimator_.radiance(tracer, sampler, ray);
    }

    std::string bias() const override { return bias_of_depth(estimator_.max_depth()); }

private:
    PathEstimator estimator_ = PathEstimator::direct_light(PathEstimator::Finder::emitter_samples);
};

template std::unique_ptr<Integrator> build<DirectEms>(const Params&);

} // namespace plumb
