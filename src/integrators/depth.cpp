// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/integrator.h"
#include "plumb/scene/tracer.h"

namespace plumb {

/// One over the distance, along the ray, between the camera and the first hit.
///
/// In units of the scene; black where there is nothing.
///
///     inverse   boolean   one over the distance; else the distance itself   (default true)
///
///         <integrator type="depth">
///             <boolean name="inverse" value="false"/>
///         </integrator>
class DepthIntegrator final : public Integrator {
public:
    explicit DepthIntegrator(const Params& params) : inverse_(params.boolean("inverse", true)) {}

    Color radiance(Tracer& tracer, Sampler&, const Ray& ray) const override
    {
        const auto hit = tracer.intersect(ray, RayKind::camera);
        if (!hit) return Color(0.f);
        const float distance = length(hit->position - ray.origin);
        return Color(inverse_ ? 1.f / distance : distance);
    }

    std::string bias() const override { return "it shows distances, not light"; }
    bool needs_lamps() const override { return false; }

private:
    bool inverse_;
};

template std::unique_ptr<Integrator> build<DepthIntegrator>(const Params&);

} // namespace plumb
