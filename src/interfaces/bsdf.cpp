// SPDX-License-Identifier: MIT

#include "plumb/bsdf.h"

#include "plumb/math.h"

namespace plumb {

Color Bsdf::albedo(const SurfacePoint& at, const Vec3f& wi) const
{
    // A lattice in three dimensions (Korobov 1959), its points in the middles of their cells.
    constexpr int points = 16;
    constexpr int factor = 5;
    Color sum(0.f);
    for (int i = 0; i < points; ++i) {
        const auto place = [&](int step) {
            return (static_cast<float>(i * step % points) + 0.5f) / static_cast<float>(points);
        };
        const auto sampled = sample(at, wi, place(1), {place(factor), place(factor * factor)});
        if (sampled) sum += sampled->weight * sqr(sampled->eta);
    }
    return sum / static_cast<float>(points);
}

} // namespace plumb
