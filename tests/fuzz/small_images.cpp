// SPDX-License-Identifier: MIT

// Stands in for src/image/image_limits.cpp: a few bytes may claim to be millions of pixels, which takes time and finds
// nothing.

#include "image/image_limits.h"

namespace plumb {

void check_size(const PixelRect& data, std::size_t channels)
{
    constexpr double most_values = 1 << 18;
    if (data.width < 1 || data.height < 1 || channels < 1) throw Error("there is nothing in the image");
    if (double(data.width) * double(data.height) * double(channels) > most_values)
        throw not_enough_memory(data);
}

PixelRect seen_from_corner(const PixelRect& data, const PixelRect& full)
{
    constexpr int farthest = 1 << 29;
    for (const int place : {data.x, data.y, full.x, full.y, data.width, data.height, full.width, full.height})
        if (place < -farthest || place > farthest) throw Error("the pixels are too far out");
    return {data.x - full.x, data.y - full.y, data.width, data.height};
}

Error not_enough_memory(const PixelRect&)
{
    return Error("not enough memory");
}

} // namespace plumb
