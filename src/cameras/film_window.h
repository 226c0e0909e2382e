// SPDX-License-Identifier: MIT
#pragma once

// Which pixels of a camera's full image are rendered: its parameters width, height, crop* and sampleBorder.

#include "plumb/model/params.h"

namespace plumb {

struct FilmWindow {
    explicit FilmWindow(const Params& params);

    Vec2i full;       // pixels of the view
    Vec2i resolution; // of what is rendered
    Vec2f offset;     // of its upper left corner in the full image
    bool sample_border = true;
};

} // namespace plumb
