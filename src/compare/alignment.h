// SPDX-License-Identifier: MIT
#pragma once

// Mistakes between two renderers that are no errors of light: mirrored images, half a pixel, exposure, encoding.

#include "compare/estimate.h"

namespace plumb {

// Of images that differ: the change after which the same test finds no difference, at the significance times the number
// of changes that are tried. found_by_shift_alone: only test_shifts() has found the difference. Nothing: none.
std::optional<Alignment> find_alignment(const ComparedImage& a, const ComparedImage& b,
                                        const CompareSettings& options, bool found_by_shift_alone);

} // namespace plumb
