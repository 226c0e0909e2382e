// SPDX-License-Identifier: MIT
#pragma once

// The rectangle of an environment's map that a cell of the guide sees.

#include "integrators/sky_guide.h"

#include <optional>
#include <span>

namespace plumb {

// Light that has come from the environment.
struct SkyRay {
    Vec3f position; // where it arrived
    Vec2f place;    // on the map
    // An estimate of what it adds to the second moment of (radiance times cosine) / density, where the environment chooses among all
    // directions.
    double moment;
};

// Nothing where choosing in the rectangle is not expected to help much.
std::optional<SkyGuide::Window> fit_window(const SkyMap& map, std::span<const SkyRay> rays);

} // namespace plumb
