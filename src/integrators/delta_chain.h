// SPDX-License-Identifier: MIT
#pragma once

// A technique for path_loop.h that follows delta bounces only and leaves the rest to its direct().

#include "integrators/path_loop.h"

namespace plumb {

struct DeltaChain {
    bool counts_passes() const { return false; }
    bool counts_emission(const PathState& path) const { return path.delta; }
    float emission_weight(const PathState&, float) const { return 1.f; }

    std::optional<BsdfSample> scatter(Sampler& sampler, const Vertex& vertex) const
    {
        if (!vertex.has_delta_lobes()) return std::nullopt;
        const float u_lobe = sampler.next_1d();
        const Vec2f u = sampler.next_2d();
        std::optional<BsdfSample> next = vertex.sample(u_lobe, u);
        if (next && !next->is_delta()) next.reset();
        return next;
    }
};

// At most one bounce: direct light.
struct SingleDiscreteBounce : DeltaChain {
    int max_depth() const { return 1; }
    float survival(const PathState&, int) const { return 1.f; }
};

} // namespace plumb
