// SPDX-License-Identifier: MIT
#pragma once

// Light on its way from the lamps through the links of chains (guided_path.h), mirrors, glass and what is nearly as smooth, to the first
// surface that scatters it: what caustic_guide.h learns from.
//
// [1] Jensen 1995, "Importance Driven Path Tracing using the Photon Map"

#include "plumb/scene/scene.h"

#include <vector>

namespace plumb {

// Links between a surface that scatters and the emitter, at most: those that are guided.
inline constexpr int longest_chain = 16;

// World space. All photons stand for as much light.
struct CausticPhoton {
    Vec3f position;         // on the surface that scatters
    Vec3f towards;          // unit vector, to where the photon came from
    float cosine = 0.f;     // between the shading normal and towards, not negative
    float to_last = 0.f;    // distance to the last link
    float irradiance = 0.f; // an estimate of what arrives there straight from emitters, luminance
    bool is_glossy = false; // a link of its chain was shiny
    float to_emitter = 0.f; // along the whole chain; for infinite emitters far outside the scene
};

struct CausticPhotons {
    std::vector<CausticPhoton> photons; // in an order that depends on the scene alone
    std::uint64_t emitted = 0;
    double flux = 0.0; // of each, luminance, roughly
};

// Emits so many photons, rounded up to a multiple of 1024, and keeps those that arrive; none where no surface throws caustics (bsdf.h) or
// no emitter can be met by a path. A pure function of the scene and their number: no threads, no seed. threads as in parallel_for.
CausticPhotons trace_caustic_photons(const Scene& scene, std::size_t photons, int threads);

} // namespace plumb
