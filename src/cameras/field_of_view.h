// SPDX-License-Identifier: MIT
#pragma once

// How wide a view is: what perspective cameras and projectors have in common.

#include "plumb/model/params.h"

namespace plumb {

// Half the width and height of the image in the plane at distance 1.
struct FieldOfView {
    double half_width = 1.0;
    double half_height = 1.0;
};

// The parameters fov, fovAxis and focalLengthMm, of an image with this many pixels.
FieldOfView read_field_of_view(const Params& params, Vec2i resolution);

} // namespace plumb
