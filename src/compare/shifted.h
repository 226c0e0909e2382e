// SPDX-License-Identifier: MIT
#pragma once

// Two images of which one is moved by a pixel or by half of one. Pixels that are then missing are not a number in both.

#include "compare/estimate.h"

namespace plumb {

struct ImagePair {
    ComparedImage a;
    ComparedImage b;
};

// Without error bars and contributing samples.
void drop_noise(ComparedImage& image);

// The pixel of A at (half_x / 2, half_y / 2) comes to (0, 0). By half pixels: A is averaged over 4 neighbours with the
// weights of cos^3(w / 2), which are half a pixel off, and B over 5 with those of the mean of cos^2 and cos^4; then
// neither has error bars.
ImagePair shift(const ComparedImage& a, const ComparedImage& b, int half_x, int half_y);
// Both averaged as B is, and none moved; by whole pixels: as they are, without what would be missing.
ImagePair unshifted(const ComparedImage& a, const ComparedImage& b, int half_x, int half_y);

// "shifted half a pixel right and 1 pixel up": how A is moved.
std::string shift_text(int half_x, int half_y);

} // namespace plumb
