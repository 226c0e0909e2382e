// SPDX-License-Identifier: MIT
#pragma once

// What OpenEXR's headers have in common with our idea of them.

#include "plumb/image/image.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>

#include <string>
#include <string_view>
#include <vector>

namespace plumb::lean {

// The pixels that exist, seen from the corner of the full image, and the full image's size. Throws Error if they are too far
// from it.
struct Windows {
    PixelRect data;
    int full_width = 0;
    int full_height = 0;
};
Windows windows_of(const Imf::Header& header);

struct Channel {
    std::string name;
    Imf::PixelType type;
};

// In the order in which OpenImageIO has them: layer by layer, and in it R, G, B and so on before others. Throws Error for
// channels with fewer samples than pixels.
std::vector<Channel> channels_of(const Imf::Header& header);

Metadata metadata_of(const Imf::Header& header);

// compression: "zip", "rle" and so on. Throws Error for another word.
Imf::Header header_of(const PixelRect& data, int full_width, int full_height, const Metadata& metadata,
                      std::string_view compression);

} // namespace plumb::lean
