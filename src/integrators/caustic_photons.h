// SPDX-License-Identifier: MIT
#pragma once

// Light on its way from the lamps through mirrors and glass to the first surface that scatters it: what caustic_guide.h
// learns from.
//
// [1] Jensen 1995, "Importance Driven Path Tracing using the Photon Map"

#include "plumb/scene/scene.h"

#include <vector>

namespace plumb {

// Delta bounces between a surface that scatters and the emitter, at most: those that are guided.
inline constexpr int longest_chain = 16;

// World space. All photons stand for as much light.
struct CausticPhoton {
    Vec3f position;         // on the surface that scatters
    Vec3f towards;          // unit vector, to where the photon came from
    float cosine = 0.f;     // between the shading normal and towards, not negative
    float to_last = 0.f;    // distance to the last delta bounce
    float to_emitter = 0.f; // along the whole chain; for infinite emitters far outside the scene
};

struct CausticPhotons {
    std::vector<CausticPhoton> photons; // in an order that depends on the scene alone
    std::uint64_t emitted = 0;
};

// Emits so many photons, rounded up to a multiple of 1024, and keeps those that arrive; none where no surface has a delta lobe or
// no emitter can be met by a path. A pure function of the scene and their number: no threads, no seed. threads as in parallel_for.
CausticPhotons trace_caustic_photons(const Scene& scene, std::size_t photons, int threads);

} // namespace plumb
