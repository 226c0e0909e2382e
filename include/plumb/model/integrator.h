// SPDX-License-Identifier: MIT
#pragma once

// The interface of integrators.

#include "plumb/math/color.h"
#include "plumb/math/ray.h"

#include <string>

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

    // How the expectation of radiance() differs from the light that arrives, by the integrator's nature or its
    // parameters: "light of more than 5 surface bounces is left out". Empty where it does not.
    virtual std::string bias() const = 0;

    // Whether it notes each contribution to a sample (scene/light_notes.h), so that layers can be of parts of the light.
    virtual bool notes_light() const { return false; }

    // How many times, at most, each sample is to look for lamps where their outlines are seen (render/outlines.h). Above 0 only of
    // integrators that have look().
    virtual int outline_rays() const { return 0; }
    // An estimate of a part of radiance(): the light of lamps that the camera sees along `ray`, directly, by delta bounces, or
    // by one glossy bounce after those. radiance() leaves this part out where the tracer expects looks. How the two share light that both
    // can find may depend on how many.
    virtual Color look(Tracer&, Sampler&, const Ray&) const { return Color(0.f); }

    // Whether a scene without lamps is black.
    virtual bool needs_lamps() const { return true; }
};

} // namespace plumb
