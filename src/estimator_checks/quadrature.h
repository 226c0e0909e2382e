// SPDX-License-Identifier: MIT
#pragma once

// Integrals over rectangles.

#include <functional>

namespace plumb {

struct Rectangle2d {
    double x0, x1;
    double y0, y1;
};

// The integral of f over `area`, which is cut into parts x parts rectangles; those are halved both ways until the
// parts agree with the whole to about `tolerance`. A peak narrower than a part can be missed.
double integrate(const std::function<double(double, double)>& f, const Rectangle2d& area, int parts,
                 double tolerance);

} // namespace plumb
