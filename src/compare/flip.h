// SPDX-License-Identifier: MIT
#pragma once

// FLIP: how large a difference between two images appears to somebody who flips between them.
//
// [1] Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for
//     Alternating Images", https://doi.org/10.1145/3406183
// [2] Andersson, Nilsson, Shirley and Akenine-Moeller 2021, "Visualizing Errors in Rendered High Dynamic Range
//     Images", https://doi.org/10.2312/egs.20211015
//
// Conventions. Colours are linear Rec. 709, rows from the top. What the papers leave to the user has their default:
// 67 pixels per degree (0.7 m from a screen that is 0.7 m and 3840 pixels wide), and the ACES tone curve.

#include "plumb/math/color.h"

#include <vector>

namespace plumb {

// The error of each pixel, in [0, 1], and its mean over the image.
struct FlipError {
    std::vector<float> map;
    double mean = 0.0;
};

// width x height colours each; none may be infinite or not a number.
FlipError ldr_flip(const std::vector<Color>& reference, const std::vector<Color>& test, int width,
                   int height); // colours are clamped to [0, 1]

// The largest LDR-FLIP error over a range of exposures that follows from the reference. Where [2] has no range,
// because half of the reference is black, the median is that of the other half; negative colours count as black.
FlipError hdr_flip(const std::vector<Color>& reference, const std::vector<Color>& test, int width,
                   int height);

} // namespace plumb
