// SPDX-License-Identifier: MIT
#pragma once

// FLIP of two images as a screen shows them. Numbers of papers and equations: see compare/flip.h.

#include "plumb/math/math.h"

#include <vector>

namespace plumb::flip {

struct Size {
    int width;
    int height;

    std::size_t columns() const { return static_cast<std::size_t>(width); }
    std::size_t rows() const { return static_cast<std::size_t>(height); }
    std::size_t pixels() const { return columns() * rows(); }
};

// The error of each pixel ([1], section 4.3); the colours are linear, in [0, 1].
std::vector<float> ldr_errors(const std::vector<Vec3d>& reference, const std::vector<Vec3d>& test,
                              const Size& size);

} // namespace plumb::flip
