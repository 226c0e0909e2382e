// SPDX-License-Identifier: MIT
#pragma once

// What integrators learn before they render.

#include <cstdint>
#include <optional>

namespace plumb {

class Camera;
class Integrator;
class Scene;

// What an integrator has learnt about where light comes from, and how long that took.
struct GuideFacts {
    std::uint64_t emitted = 0; // photons
    std::uint64_t arrived = 0; // of them, on surfaces that a guide can serve
    std::uint64_t cells = 0;   // of space, that have a guide; 0: there is none, and nothing is slower for it
    std::uint64_t paths = 0;   // from the camera, that looked for an environment
    std::uint64_t windows = 0; // parts of it that cells of space see; 0: nothing is slower for it
    double seconds = 0.0;
};

// Beside Integrator, the interface of those that learn from a scene, and a camera, how radiance() is less noisy. Without train() they render
// the same image with more noise.
class Guided {
public:
    virtual ~Guided() = default;

    // Learns from the scene that the integrator was prepared for: a pure function of the scene, on so many threads (0: all).
    // Before a rendering's first sample; only the first call takes time. Called by any thread.
    virtual void train(const Scene& scene, const Camera& camera, int threads) const = 0;
    // What train() has learnt; nothing where there was nothing to learn from.
    virtual std::optional<GuideFacts> guide() const = 0;
};

// Of an integrator that learns; nothing of others.
std::optional<GuideFacts> train(const Integrator& integrator, const Scene& scene, const Camera& camera,
                                int threads);
std::optional<GuideFacts> guide_of(const Integrator& integrator);

} // namespace plumb
