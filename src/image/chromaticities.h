// SPDX-License-Identifier: MIT
#pragma once

// Colour spaces of images, by the CIE 1931 xy of their primaries and of their white: the attribute `chromaticities` of
// OpenEXR files. Plumb's is linear sRGB.

#include "plumb/image/image.h"

#include <array>
#include <optional>

namespace plumb {

// x and y of red, green, blue and white.
using Chromaticities = std::array<float, 8>;

inline constexpr const char* chromaticities_name = "chromaticities";
inline constexpr Chromaticities srgb_chromaticities = {0.64f, 0.33f, 0.3f,    0.6f,
                                                       0.15f, 0.06f, 0.3127f, 0.329f};

// What the header of an image says; nothing if it says nothing.
std::optional<Chromaticities> chromaticities_of(const Metadata& metadata);

// Row by row: what makes linear sRGB of linear colours of another space. White becomes white: the white points are adapted
// after Bradford. Nothing if it is sRGB already, within the rounding of files. Throws Error if they are no colour space.
std::optional<std::array<double, 9>> to_srgb(const Chromaticities& from);

} // namespace plumb
