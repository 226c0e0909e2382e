// SPDX-License-Identifier: MIT
#pragma once

// The interface of integrators.

#include "plumb/math/color.h"
#include "plumb/math/ray.h"

#include <cstdint>
#include <optional>
#include <string>

namespace plumb {

class Sampler;
class Scene;
class Tracer;

// What an integrator has learnt about where light comes from, and how long that took.
struct GuideFacts {
    std::uint64_t emitted = 0; // photons
    std::uint64_t arrived = 0; // of them, on surfaces that a guide can serve
    std::uint64_t cells = 0;   // of the surfaces, that have a guide; 0: there is none, and nothing is slower for it
    double seconds = 0.0;
};

class Integrator {
public:
    virtual ~Integrator() = default;

    // Called once, when the scene is complete. Throws Error if the integrator cannot render it.
    virtual void prepare(const Scene&) {}

    // Learns from the scene that it is prepared for what makes radiance() less noisy: a pure function of the scene. Before a
    // rendering's first sample; only the first call takes time. From any thread. threads as in RenderOptions.
    virtual void train(const Scene&, int /*threads*/) const {}
    // What train() has learnt; nothing where there was nothing to be trained.
    virtual std::optional<GuideFacts> guide() const { return std::nullopt; }

    // An unbiased estimate of the radiance that arrives along `ray`, against its direction. Calls the sampler in an
    // order that depends on the path alone.
    virtual Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const = 0;

    // How the expectation of radiance() differs from the light that arrives, by the integrator's nature or its
    // parameters: "light of more than 5 surface bounces is left out". Empty where it does not.
    virtual std::string bias() const = 0;

    // Whether it notes each contribution to a sample (scene/light_notes.h), so that layers can be of parts of the light.
    virtual bool notes_light() const { return false; }

    // Whether a scene without lamps is black.
    virtual bool needs_lamps() const { return true; }
};

} // namespace plumb
