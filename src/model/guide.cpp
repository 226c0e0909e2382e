// SPDX-License-Identifier: MIT

#include "plumb/model/guide.h"

#include "plumb/model/integrator.h"

namespace plumb {

std::optional<GuideFacts> train(const Integrator& integrator, const Scene& scene, const Camera& camera,
                                int threads)
{
    if (const auto* const guided = dynamic_cast<const Guided*>(&integrator))
        guided->train(scene, camera, threads);
    return guide_of(integrator);
}

std::optional<GuideFacts> guide_of(const Integrator& integrator)
{
    const auto* const guided = dynamic_cast<const Guided*>(&integrator);
    return guided ? guided->guide() : std::nullopt;
}

} // namespace plumb
