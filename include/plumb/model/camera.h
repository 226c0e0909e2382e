// SPDX-License-Identifier: MIT
#pragma once

// The interface of cameras.

#include "plumb/math/color.h"
#include "plumb/math/ray.h"
#include "plumb/math/transform.h"

namespace plumb {

// Conventions. raster: continuous pixel coordinates; (0, 0) is the upper left corner of the full image, pixel
// (x, y) covers [x, x + 1) x [y, y + 1). Rays are in world space; with a unit direction. Camera space: +z looks
// forward, +y up, +x left (transform.h, look_at).
struct CameraRay {
    Ray ray;
    Color weight;
};

class Camera {
public:
    virtual ~Camera() = default;
    virtual CameraRay sample_ray(const Vec2f& raster, const Vec2f& u_lens) const = 0;
    virtual Vec2i resolution() const = 0;
    virtual const Transform& to_world() const = 0;
    // Whether filters reach beyond the edge of the image; else they are cut there, and what is left of them counts as all.
    virtual bool sample_border() const { return true; }
};

} // namespace plumb
