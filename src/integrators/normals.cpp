// SPDX-License-Identifier: MIT

#include "model/plugin.h"
#include "plumb/model/integrator.h"
#include "plumb/scene/tracer.h"

namespace plumb {

/// The shading normal at the first hit, in world space, as a colour: the absolute values of x, y and z.
///
/// Black where there is nothing. No parameters.
///
///         <integrator type="normals"/>
class NormalsIntegrator final : public Integrator {
public:
    explicit NormalsIntegrator(const Params&) {}

    Color radiance(Tracer& tracer, Sampler&, const Ray& ray) const override
    {
        const auto hit = tracer.intersect(ray, RayKind::camera);
        if (!hit) return Color(0.f);
        const Vec3f n = abs(hit->shading.n);
        return {n.x, n.y, n.z};
    }

    std::string bias() const override { return "it shows normals, not light"; }
    bool needs_lamps() const override { return false; }
};

template std::unique_ptr<Integrator> build<NormalsIntegrator>(const Params&);

} // namespace plumb
