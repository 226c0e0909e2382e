// SPDX-License-Identifier: MIT
#pragma once

// Pixels as the codecs of src/image/lean hand them over.

#include "image/image_module.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::lean {

// Of 32-bit floats. clear: all are 0; else they are anything. Throws Error.
std::unique_ptr<PixelBuffer> make_floats(const PixelRect& data, std::size_t channels, bool clear);

// The integers of a file as they are in it: rows from the top, the channels of a pixel side by side.
struct Raster {
    PixelRect data; // in the file's coordinates, as `full`
    PixelRect full;
    std::vector<std::string> channels;
    int alpha_channel = -1;
    std::size_t value_size = 1; // bytes: 1 or 2, those in this machine's order
    std::unique_ptr<unsigned char[]> values = nullptr;
    Metadata metadata = {};

    std::size_t row_size() const
    {
        return static_cast<std::size_t>(data.width) * channels.size() * value_size;
    }
    unsigned char* row(int y) const { return values.get() + static_cast<std::size_t>(y) * row_size(); }
};

// 1 to 4 channels, named as OpenImageIO names them. The values are anything: a broken file may claim any size, and memory
// that is not touched costs nothing. Throws Error.
Raster make_raster(int width, int height, std::size_t channels, std::size_t value_size);

DecodedImage decoded(Raster raster); // values / largest
std::optional<ByteImage> byte_image(const Raster& raster);

// Of metadata, as OpenImageIO compares them: capitals count as small letters.
bool same_name(std::string_view a, std::string_view b);

// Replaces what has that name.
void put(Metadata& metadata, std::string_view name, MetadataValue value);

} // namespace plumb::lean
