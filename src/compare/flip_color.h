// SPDX-License-Identifier: MIT
#pragma once

// The colour spaces of FLIP, in double precision. Numbers of equations are those of [1] in compare/flip.h.

#include "plumb/math/color.h"

namespace plumb::flip {

// Y, Cx and Cz: the linear opponent space in which the eye's contrast sensitivity is given ([1], section 4.1.1).
Vec3d ycxcz_from_linear(const Vec3d& rgb);
Vec3d linear_from_ycxcz(const Vec3d& ycxcz);

// CIELAB under D65, with the Hunt effect: dark colours look less colourful ([1], section 4.1.2).
Vec3d hunt_lab_from_linear(const Vec3d& rgb);

// The HyAB distance: city blocks in lightness, Euclid in the plane of hues ([1], section 4.1.2).
double hyab(const Vec3d& a, const Vec3d& b);

double power(double base, double exponent); // base >= 0

} // namespace plumb::flip
