// SPDX-License-Identifier: MIT
#pragma once

// The interface of cameras.

#include "plumb/math/color.h"
#include "plumb/math/ray.h"
#include "plumb/math/transform.h"

#include <algorithm>
#include <optional>

namespace plumb {

// Conventions. raster: continuous pixel coordinates; (0, 0) is the upper left corner of the full image, pixel
// (x, y) covers [x, x + 1) x [y, y + 1). Rays are in world space; with a unit direction. Camera space: +z looks
// forward, +y up, +x left (transform.h, look_at).
struct CameraRay {
    Ray ray;
    Color weight;
};

// A part of the film's plane, in raster coordinates; empty where min exceeds max.
struct RasterBounds {
    Vec2f min{infinity};
    Vec2f max{-infinity};

    void add(const Vec2f& raster)
    {
        min = {std::min(min.x, raster.x), std::min(min.y, raster.y)};
        max = {std::max(max.x, raster.x), std::max(max.y, raster.y)};
    }
};

class Camera {
public:
    virtual ~Camera() = default;
    virtual CameraRay sample_ray(const Vec2f& raster, const Vec2f& u_lens) const = 0;
    virtual Vec2i resolution() const = 0;
    virtual const Transform& to_world() const = 0;
    // Whether filters reach beyond the edge of the image; else they are cut there, and what is left of them counts as all.
    virtual bool sample_border() const { return true; }
    // Where the box is seen if nothing hides it. What lies very close before the camera may be missing. Nothing if the camera
    // cannot tell.
    virtual std::optional<RasterBounds> bounds_of(const Box3f& /*world*/) const { return std::nullopt; }
};

} // namespace plumb
