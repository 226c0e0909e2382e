// SPDX-License-Identifier: MIT
#pragma once

// How an image is cut into tiles: a pure function. The cut changes no bit of the image.

#include "plumb/image/image.h"

#include <algorithm>
#include <vector>

namespace plumb {

// Tiles of at most size x size pixels that cover `window` once, row by row.
inline std::vector<PixelRect> cut_into_tiles(const PixelRect& window, int size)
{
    std::vector<PixelRect> tiles;
    const int right = window.x + window.width;
    const int bottom = window.y + window.height;
    for (int y = window.y; y < bottom; y += size)
        for (int x = window.x; x < right; x += size)
            tiles.push_back({x, y, std::min(size, right - x), std::min(size, bottom - y)});
    return tiles;
}

} // namespace plumb
