// SPDX-License-Identifier: MIT
#pragma once

// The squares into which a test divides an image. Sizes in pixels.

#include "plumb/image/image.h"

#include <algorithm>
#include <cstddef>

namespace plumb {

// Squares of one size, row by row. size 0: one square, the whole.
struct Squares {
    int size = 0;
    std::size_t columns = 1;
    std::size_t rows = 1;

    Squares(int side, const PixelRect& window) : size(side)
    {
        if (side == 0) return;
        columns = static_cast<std::size_t>((window.width + side - 1) / side);
        rows = static_cast<std::size_t>((window.height + side - 1) / side);
    }
    std::size_t count() const { return columns * rows; }
    // x, y: from the corner of the window.
    std::size_t index(int x, int y) const
    {
        if (size == 0) return 0;
        return static_cast<std::size_t>(y / size) * columns + static_cast<std::size_t>(x / size);
    }
    PixelRect place(std::size_t square, const PixelRect& window) const
    {
        if (size == 0) return window;
        const int x = static_cast<int>(square % columns) * size;
        const int y = static_cast<int>(square / columns) * size;
        return {window.x + x, window.y + y, std::min(size, window.width - x),
                std::min(size, window.height - y)};
    }
};

} // namespace plumb
