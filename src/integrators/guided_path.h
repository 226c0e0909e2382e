// SPDX-License-Identifier: MIT
#pragma once

// The path tracer that looks for emitters in a third way: from surfaces with a diffuse lobe, through chains of mirrors, glass and what is nearly
// as smooth, in directions that a guide knows.
//
// The links of a chain are delta bounces and bounces at shiny surfaces (Vertex::is_link), `longest_chain` at most. It begins at a
// surface with a diffuse lobe, and finds what its links find: the emitters that its rays meet, and emitter samples at shiny links. Two
// directions at its beginning lead there, one of the BSDF and one of the guide. What follows from a direction has the same
// expectation, whoever chose it, so the densities of the two decide their weights (Veach 1997, section 9.2). What lies behind
// no link, or behind more than `longest_chain`, is left to the BSDF and to emitter samples.

#include "integrators/caustic_guide.h"
#include "integrators/path_estimator.h"

#include <algorithm>
#include <vector>

namespace plumb {

struct GuidedPathState : PathState {
    using PathState::PathState;

    void extend(const Vertex& vertex, const BsdfSample& next)
    {
        PathState::extend(vertex, next);
        if (vertex.is_link(next)) {
            ++chain;
            return;
        }
        chain = 0;
        cell = cell_here;
        directions = directions_here;
        pdf_of_direction = next.pdf;
        position = vertex.at().position;
        direction = vertex.to_world(next);
    }

    const GuideCell* cell_here = nullptr; // of the vertex that is being looked at
    float directions_here = 0.f;          // how many guided ones are taken there, expected
    // Of the last vertex that was no link.
    const GuideCell* cell = nullptr;
    float directions = 0.f;
    Vec3f position{0.f};
    Vec3f direction{0.f}; // in world space
    float pdf_of_direction = 0.f;
    int chain = 0; // links since then

    float u_survival = 0.f; // for roulette at the vertex that is being looked at

    // Light that chains have met, and that waits for the path to come to its depth.
    struct Waiting {
        int depth;
        FoundBy by;
        std::uint32_t emitter;
        Color contribution;
    };
    std::vector<Waiting> waiting; // by depth, the first found first

    void wait(const Waiting& found)
    {
        const auto is_before = [](const Waiting& a, const Waiting& b) { return a.depth < b.depth; };
        waiting.insert(std::upper_bound(waiting.begin(), waiting.end(), found, is_before), found);
    }
};

class GuidedPath : public PathEstimator {
public:
    using State = GuidedPathState;

    // The guide must live as long.
    GuidedPath(const PathEstimator& estimator, const CausticGuide& guide)
        : PathEstimator(estimator), guide_(&guide)
    {}

    Color radiance(Tracer& tracer, Sampler& sampler, const Ray& ray) const;

    // Asked by path_loop.h beside what it asks of every technique.
    float chain_weight(const GuidedPathState& path, int more_links) const;
    void find_chains(Tracer& tracer, Sampler& sampler, GuidedPathState& path, const Vertex& vertex,
                     int bounces) const;
    Color with_waiting(Tracer& tracer, GuidedPathState& path, int depth, Color sum) const;

private:
    struct Chain {
        PathState path;
        Ray ray;           // its next one
        int depth;         // surface bounces so far
        std::uint64_t key; // of its random numbers
    };
    // What it finds waits in `path`.
    void follow(Tracer& tracer, GuidedPathState& path, Chain chain) const;
    // From a link.
    void find_direct(Tracer& tracer, Sampler& sampler, GuidedPathState& path, const Chain& chain,
                     const Vertex& vertex) const;

    const CausticGuide* guide_;
};

} // namespace plumb
