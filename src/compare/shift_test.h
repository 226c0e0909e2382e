// SPDX-License-Identifier: MIT
#pragma once

// Is A shifted by a pixel or by half of one? Where images are equal but for their noise and this, the differences at an
// edge have either sign and sum up to nothing.

#include "compare/estimate.h"

namespace plumb {

// The shift of A with which the squared differences are smaller than without it, most beyond the noise; p: of any of
// those that are tried. Nothing: too few squares of 16x16 pixels.
std::optional<Alignment> test_shifts(const ComparedImage& a, const ComparedImage& b);

} // namespace plumb
