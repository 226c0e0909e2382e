// SPDX-License-Identifier: MIT
#pragma once

// Images in memory and on disk. What reads and writes files is a library of its own, with OpenImageIO or without
// (src/image/oiio, src/image/lean); a file whose format it lacks is an error.
//
// Conventions. Row 0 is the top row. Values are linear light unless a parameter says otherwise.

#include "plumb/math/color.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace plumb {

// A rectangle of pixels: columns [x, x + width), rows [y, y + height).
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

// What an image file's header says, in a fixed order. Matrices are 16 floats, row-major.
using MetadataValue = std::variant<int, float, std::string, std::vector<float>>;
using Metadata = std::vector<std::pair<std::string, MetadataValue>>;

class Image {
public:
    // data: the pixels that exist, inside a full image of full_width x full_height. Throws Error if memory is short.
    Image(PixelRect data, int full_width, int full_height,
          std::vector<std::string> channels = {"R", "G", "B"});
    Image(int width, int height) : Image({0, 0, width, height}, width, height) {}
    Image(Image&&) noexcept;
    Image& operator=(Image&&) noexcept;
    ~Image();

    const PixelRect& data_window() const;
    int full_width() const;
    int full_height() const;
    int channel_count() const;
    const std::vector<std::string>& channel_names() const;

    // x, y: inside the data window, in coordinates of the full image. channel_count() floats.
    float* pixel(int x, int y);
    const float* pixel(int x, int y) const;
    Color color(int x, int y) const; // the first three channels, or the first one three times

    Metadata metadata; // what read_image found, and what write_image writes

private:
    friend Image read_image(const std::filesystem::path& path, bool decode_srgb);
    struct Impl;
    explicit Image(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// Reads any format that the image library reads: with OpenImageIO any that that reads, without EXR, PNG, JPEG, HDR, BMP and
// TGA. Integer formats become value / maximum. decode_srgb makes linear sRGB of what are colours: it undoes the sRGB curve
// for 8-bit and 16-bit integer formats (floating-point formats are linear), and converts the channels R, G and B of a
// floating-point format whose attribute `chromaticities` names another colour space. Throws Error naming the file.
Image read_image(const std::filesystem::path& path, bool decode_srgb);

// An image file of 8-bit integers as it is: rows from the top, 1 or 3 channels (alpha is left out).
struct ByteImage {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<std::uint8_t> values;
};

// Nothing if the file has values of another kind: read_image reads it. Throws as that does.
std::optional<ByteImage> read_byte_image(const std::filesystem::path& path);

// What the 8-bit values stand for: value / 255, through the sRGB curve if asked. The same as read_image gives.
std::array<float, 256> byte_values(bool decode_srgb);

bool is_jpeg(const std::filesystem::path& path); // by what the file begins with; false if it cannot be read

// What decodes JPEG, with its version: JPEG's decoders may differ in the last bit. Loads the image library.
std::string jpeg_decoder();

// Channels of a rendered image that do not say how it looks: those of layers, "variance.R" or "normal.X", and "contributing".
inline bool is_layer_channel(const std::string& name)
{
    return name.find('.') != std::string::npos || name == "contributing";
}

// How an image is compressed, without loss: fast takes a sixth of the time of small for an .exr, which gets some 12 % larger
// where it is noisy, and much larger where it is smooth.
enum class Packing { small, fast };

// How light becomes values for a screen (development.h): multiplied by 2^exposure, then through the curve.
enum class ToneCurve { none, filmic, aces, agx }; // none: what is above 1 is clipped
struct Development {
    float exposure = 0.f;
    ToneCurve curve = ToneCurve::none;
    friend bool operator==(const Development&, const Development&) = default;
};

// Writes by extension: .exr (32-bit float, ZIP or, fast, RLE, data and display window, the chromaticities
// of sRGB), .hdr, .tif/.tiff (float), .png and .jpg (8-bit sRGB, developed and rounded). The file appears whole or not at all: it is
// written beside `path` and renamed. Metadata goes into formats that can hold it; so do channels of layers, which must be
// the last ones (.exr only). Same image, same bytes.
void write_image(const std::filesystem::path& path, const Image& image, const Development& development = {},
                 Packing packing = Packing::small);

// Whether the extension is that of a format for screens, to which `development` applies: .png, .jpg and .jpeg.
bool is_for_screens(const std::filesystem::path& path);

// Throws Error if `path` cannot be written: unknown extension, missing or read-only directory, a directory of that name.
void check_image_path(const std::filesystem::path& path);

// What images take: with Debian's OpenImageIO some 260 libraries, which take a quarter of a second to load. The first
// image that is made, read or written waits for them; one of these loads them meanwhile.
class ImageLibrary {
public:
    ImageLibrary(); // begins, in a thread of its own
    ImageLibrary(const ImageLibrary&) = delete;
    ImageLibrary& operator=(const ImageLibrary&) = delete;
    ~ImageLibrary(); // waits

    bool failed() const { return failed_; } // from any thread
    void wait();                            // throws Error if it failed

    // Loads it. A hash of the file that Plumb's own part of it was loaded from, taken then; empty if it cannot be read.
    static const std::string& hash();

private:
    std::atomic<bool> failed_ = false;
    std::future<void> loading_;
};

} // namespace plumb
