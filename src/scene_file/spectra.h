// SPDX-License-Identifier: MIT
#pragma once

// Spectra as linear sRGB, by the rules of Mitsuba 3's RGB variants, so that its files keep their colours.
//
// Wavelengths are in nanometres, from 360 to 830; between its points a spectrum is linear, outside of them 0.

#include "plumb/math/math.h"

#include <span>
#include <string_view>
#include <vector>

namespace plumb {

struct SpectrumPoint {
    double wavelength, value;
};

// Light: an equal-energy spectrum of 1 has a luminance of 1. Negative channels become 0.
Vec3d color_of_light(std::span<const SpectrumPoint> spectrum);
// The equal-energy spectrum of 1, which is not grey in sRGB: (1.2048, 0.9483, 0.9089).
Vec3d color_of_equal_energy();
// What reflects or refracts, under the illuminant D65. Negative channels become 0.
Vec3d color_under_d65(std::span<const SpectrumPoint> spectrum);
// A black body, in W / (m^2 sr nm): Planck's law. temperature in kelvin.
Vec3d color_of_black_body(double temperature);

} // namespace plumb
