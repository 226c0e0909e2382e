// SPDX-License-Identifier: MIT
#pragma once

// The interface of integrators.

#include "plumb/color.h"
#include "plumb/ray.h"

namespace plumb {

class Sampler;
class Scene;
class Tracer;

class Integrator {
public:
    virtual ~Integrator() = default;

    // Called once, when the scene is complete. Throws Error if the integrator cannot render it.
    virtual void prepare(const Scene&) {}

    // An unbiased estimate of the radiance that arrives along `ray`, against its direction. Calls the sampler in an
    // order that depends on the path alone.
    virtual Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const = 0;
};

} // namespace plumb
