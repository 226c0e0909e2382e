// SPDX-License-Identifier: MIT
#include "image/image_limits.h"

#include "image/image_module.h"

#include <fmt/format.h>

namespace plumb {

void check_size(const PixelRect& data, std::size_t channels)
{
    // Far more than any memory, and far from overflow.
    constexpr double most_floats = 0x1p40;
    const double floats = double(data.width) * double(data.height) * double(channels);
    if (data.width < 1 || data.height < 1 || channels < 1 || floats > most_floats)
        throw Error(fmt::format("an image cannot have {} x {} pixels of {} channels", data.width, data.height,
                                channels));
}

PixelRect seen_from_corner(const PixelRect& data, const PixelRect& full)
{
    // OpenImageIO computes with ints, and of pixels close to the largest it says that they were read when they were not.
    constexpr int farthest = farthest_pixel / 2;
    for (const int place : {data.x, data.y, full.x, full.y})
        if (place < -farthest || place > farthest)
            throw Error(fmt::format(
                "its pixels are too far from the image's corner: at {},{}, and the image at {},{}", data.x,
                data.y, full.x, full.y));
    for (const int size : {data.width, data.height, full.width, full.height})
        if (size > farthest)
            throw Error(fmt::format("it is too large: {} x {} pixels", data.width, data.height));
    return {data.x - full.x, data.y - full.y, data.width, data.height};
}

Error not_enough_memory(const PixelRect& data)
{
    return Error(fmt::format("not enough memory for an image of {} x {} pixels", data.width, data.height));
}

} // namespace plumb
