// SPDX-License-Identifier: MIT
#pragma once

// Any layer of an image as an image for screens.
//
// Colours are developed (development.h). Numbers go from black to white, or through false colours (false_color.h); vectors
// are colours, a component each; ids have colours of their own. The legend says what is what. Pixels that are not finite
// are green, but for those of colours.

#include "plumb/image/image.h"

#include <optional>
#include <string>
#include <vector>

namespace plumb {

struct NumberRange {
    double low = 0.0;
    double high = 1.0; // above low
};

struct ViewOptions {
    std::string layer = {};   // or a channel: "depth" or "depth.Z"; empty: the image's colours
    bool false_color = false; // of colours the luminance, of vectors the length
    std::optional<NumberRange> range =
        {};                       // of numbers and vectors; else from the smallest value to the largest
    bool logarithmic = false;     // numbers only
    Development development = {}; // of colours that are no false ones
};

struct ImageView {
    Image image; // linear; its header says what it shows
    Development development;
    std::vector<std::string> legend; // a line each
};

// Throws Error if there is no such layer, if it has more than three channels, or if the options do not fit it.
ImageView view_layer(const Image& image, const ViewOptions& options);

} // namespace plumb
