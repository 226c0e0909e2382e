// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/integrator.h"
#include "plumb/scene/tracer.h"

namespace plumb {

/// One over the distance, along the ray, between the camera and the first hit.
///
/// In units of the scene; black where there is nothing. No parameters.
///
///         <integrator type="depth"/>
class DepthIntegrator final : public Integrator {
public:
    explicit DepthIntegrator(const Params&) {}

    Color radiance(Tracer& tracer, Sampler&, const Ray& ray) const override
    {
        const auto hit = tracer.intersect(ray, RayKind::camera);
        if (!hit) return Color(0.f);
        return Color(1.f / length(hit->position - ray.origin));
    }

    std::string bias() const override { return "it shows distances, not light"; }
    bool needs_lamps() const override { return false; }
};

template std::unique_ptr<Integrator> build<DepthIntegrator>(const Params&);

} // namespace plumb
