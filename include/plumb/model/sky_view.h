// SPDX-License-Identifier: MIT
#pragma once

// The part of an environment that a surface sees through openings, as far as somebody knows (integrators/sky_guide.h).

#include "plumb/math/math.h"

#include <cstdint>

namespace plumb {

// On a map of all directions, from 0 to 1 along both axes: x repeats, y ends. The map is the environment's own.
struct SkyRectangle {
    float left = 0.f; // in [0, 1)
    float width = 1.f;
    float top = 0.f;
    float bottom = 1.f;
};

// What the map makes of it: whole parts of the map, around the rectangle at least, in units of the map.
struct SkyView {
    // Of the samples of a view so many are spread over the whole map, so that what is wrong about the view costs little. A power of two:
    // samples that are spread evenly are so in either part.
    static constexpr double everywhere = 0.125;

    std::uint32_t left = 0;
    std::uint32_t right =
        0; // 0: the whole map; else above left, perhaps beyond the map's right, where it repeats
    std::uint32_t top = 0;
    std::uint32_t bottom = 0;
    double share = 1.0; // of all light; positive

    bool is_whole() const { return right == 0; }
};

// The interface of infinite emitters that choose directions by LightReceiver::sky.
class SkyMap {
public:
    virtual ~SkyMap() = default;

    virtual Vec2f place_of(const Vec3f& wi) const = 0;             // of a direction of unit length
    virtual SkyView view(const SkyRectangle& rectangle) const = 0; // the whole map where it has no light
    // Whether samples of the view that are not spread everywhere may show the place.
    virtual bool shows(const SkyView& view, const Vec2f& place) const = 0;
};

} // namespace plumb
