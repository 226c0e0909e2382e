// SPDX-License-Identifier: MIT
#pragma once

// The door to image files. Debian's OpenImageIO needs some 260 other libraries, which take longer to load than a mistake in
// a scene takes to be found. So what uses it (src/image/oiio) is a library of its own, libplumb_images.so, which is loaded
// when the first image is made, read or written, or before (ImageLibrary). src/image/lean is another one of that name,
// without OpenImageIO; the CMake option PLUMB_IMAGES chooses.

#include "image/image_words.h"
#include "plumb/image/image.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace plumb {

// Rows from the top, without padding.
class PixelBuffer {
public:
    virtual ~PixelBuffer() = default;
    virtual float* pixels() = 0;
};

// No image has a pixel farther than that from the full image's corner, and none is larger: ends of windows are ints.
inline constexpr int farthest_pixel = 1 << 30;

// A file's image: integers are divided by their maximum.
struct DecodedImage {
    PixelRect data;
    int full_width = 0;
    int full_height = 0;
    std::vector<std::string> channels;
    std::unique_ptr<PixelBuffer> buffer;
    std::size_t integer_levels = 0; // 256 or 65536; 0: floats
    int alpha_channel = -1;
    Metadata metadata;
};

// An image on its way into a file.
struct ImageFile {
    std::string name; // its extension says the format
    PixelRect data = {};
    int full_width = 0;
    int full_height = 0;
    std::vector<std::string> channels = {};
    const Metadata& metadata;
    Metadata format = {};                // what else the format is told: compression and the like
    const float* floats = nullptr;       // either these,
    int floats_per_pixel = 0;            // so far apart,
    const std::uint8_t* bytes = nullptr; // or these
};

// All throw Error with the reason, in whatever words the libraries have for it, std::bad_alloc, or what OpenImageIO lets
// through.
class ImageModule {
public:
    virtual ~ImageModule() = default;

    // clear: all values are 0; else they are anything, and memory that is not touched costs nothing.
    virtual std::unique_ptr<PixelBuffer> make_buffer(const PixelRect& data, int full_width, int full_height,
                                                     const std::vector<std::string>& channels,
                                                     bool clear) const = 0;
    virtual DecodedImage read(const std::string& name) const = 0;
    // Nothing if its values are not 8-bit integers.
    virtual std::optional<ByteImage> read_bytes(const std::string& name) const = 0;
    // Throws Error if this build cannot write the format of a file of that name.
    virtual void check_written_format(const std::string& name) const = 0;
    virtual std::vector<unsigned char> encode(const ImageFile& image) const = 0;
    virtual std::vector<unsigned char> encode_words(const WordImage& image, const FillRows& fill) const = 0;
    virtual void read_words(const std::string& name, const ChooseChannels& choose,
                            const UseRow& use) const = 0;
    // What decodes JPEG, with its version: another one may give other values.
    virtual std::string jpeg_decoder() const = 0;
};

// Loads it, once. Throws Error if it is not there or cannot be loaded.
const ImageModule& image_module();

} // namespace plumb
