// SPDX-License-Identifier: MIT

// Windows' bitmaps.
//
// [1] "Bitmap Storage", https://learn.microsoft.com/windows/win32/gdi/bitmap-storage, and BITMAPINFOHEADER there

#include "image/bytes.h"
#include "image/lean/codecs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

namespace plumb::lean {

namespace {

enum Compression : unsigned { none = 0, rle8 = 1, rle4 = 2, bit_fields = 3 }; // [1]

using Color = std::array<unsigned char, 3>;

struct Header {
    std::size_t pixels_at = 0;
    int width = 0;
    int height = 0;
    bool from_top = false;
    unsigned bits = 0; // of a pixel
    unsigned compression = none;
    std::array<unsigned, 3> masks = {0x7c00, 0x3e0, 0x1f}; // of pixels of 16 bits
    std::vector<Color> palette = {};
};

constexpr unsigned old_header = 12; // of OS/2 and Windows 2

void read_palette(ByteReader& reader, Header& header, std::size_t entry_size, unsigned used)
{
    const unsigned most = 1u << header.bits;
    if (used > most) throw Error(fmt::format("a palette of {} colours for {} bits", used, header.bits));
    const unsigned count = used == 0 ? most : used;
    for (unsigned i = 0; i < count && reader.position() + entry_size <= header.pixels_at; ++i) {
        const Bytes entry = reader.take(entry_size);
        header.palette.push_back({entry[2], entry[1], entry[0]});
    }
    if (header.palette.empty()) throw Error("it lacks its palette");
}

Header read_header(ByteReader& reader)
{
    Header header;
    reader.take(10); // "BM", the file's size and what is reserved
    header.pixels_at = reader.number32();
    const std::size_t start = reader.position();
    const unsigned size = reader.number32();
    const bool is_old = size == old_header;
    if (!is_old && (size < 40 || size > 124)) throw Error("wrong bitmap header size");
    header.width = is_old ? static_cast<int>(reader.number16()) : reader.integer32();
    header.height = is_old ? static_cast<int>(reader.number16()) : reader.integer32();
    reader.take(2); // planes
    header.bits = reader.number16();
    unsigned used = 0;
    if (!is_old) {
        header.compression = reader.number32();
        reader.take(12); // the image's size in bytes, and pixels in a metre
        used = reader.number32();
        reader.take(4); // colours that matter
    }
    const bool has_masks = header.compression == bit_fields;
    if (has_masks)
        for (unsigned& mask : header.masks) mask = reader.number32();
    reader.go_to(std::max(reader.position(), start + size));

    header.from_top = header.height < 0;
    if (header.height == std::numeric_limits<int>::min()) throw Error("its height is no number of rows");
    header.height = std::abs(header.height);
    const unsigned bits = header.bits;
    const bool known = bits == 1 || bits == 4 || bits == 8 || bits == 16 || bits == 24 || bits == 32;
    if (!known) throw Error(fmt::format("Unsupported BMP bit depth: {}", bits));
    const bool fits = header.compression == none || (has_masks && bits >= 16) ||
                      (header.compression == rle8 && bits == 8) || (header.compression == rle4 && bits == 4);
    if (!fits) throw Error(fmt::format("Unsupported BMP compression: {}", header.compression));
    if (has_masks && bits == 32 && header.masks != std::array<unsigned, 3>{0xff0000, 0xff00, 0xff})
        throw Error("Unsupported BMP channel masks");
    if (bits <= 8) read_palette(reader, header, is_old ? 3 : 4, used);
    return header;
}

struct Free {
    void operator()(void* memory) const { std::free(memory); }
};
using Numbers = std::unique_ptr<unsigned char[], Free>;

// The numbers of the colours, encoded in runs [1]. What is skipped is 0.
Numbers read_encoded(ByteReader& reader, const Header& header)
{
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const bool halves = header.compression == rle4;
    // A broken file may claim any size: memory that is not touched costs nothing.
    Numbers pixels(static_cast<unsigned char*>(std::calloc(width, height)));
    if (!pixels) throw std::bad_alloc();
    std::size_t x = 0;
    std::size_t y = 0; // from the bottom
    const auto set = [&](unsigned char value) {
        if (x < width && y < height) pixels[y * width + x] = value;
        ++x;
    };
    const auto half = [](unsigned byte, unsigned i) {
        return static_cast<unsigned char>(i % 2 == 0 ? byte >> 4 : byte & 15);
    };
    while (true) {
        const unsigned count = reader.byte();
        const unsigned value = reader.byte();
        if (count > 0) {
            for (unsigned i = 0; i < count; ++i)
                set(halves ? half(value, i) : static_cast<unsigned char>(value));
        } else if (value == 0) { // the end of a row
            x = 0;
            ++y;
        } else if (value == 1) { // the end
            return pixels;
        } else if (value == 2) { // a leap
            x += reader.byte();
            y += reader.byte();
        } else { // so many pixels as they are, padded to two bytes
            const std::size_t bytes = halves ? (value + 1) / 2 : value;
            const Bytes plain = reader.take(bytes + bytes % 2);
            for (unsigned i = 0; i < value; ++i) set(halves ? half(plain[i / 2], i) : plain[i]);
        }
        if (y > height) throw Error("it has more rows than it says");
    }
}

// A channel of a pixel of 16 bits: its bits, repeated until there are 8.
unsigned char masked(unsigned pixel, unsigned mask)
{
    const auto bits = static_cast<unsigned>(std::popcount(mask));
    if (bits == 0) return 0;
    const unsigned value = (pixel & mask) >> std::countr_zero(mask);
    unsigned long long repeated = 0;
    unsigned count = 0;
    for (; count < 8; count += bits) repeated = repeated << bits | value;
    return static_cast<unsigned char>(repeated >> (count - 8));
}

void set_color(const Header& header, unsigned index, unsigned char* out, std::size_t channels)
{
    const Color& color = header.palette[std::min<std::size_t>(index, header.palette.size() - 1)];
    std::copy_n(color.data(), channels, out);
}

void decode_row(const Header& header, Bytes row, unsigned char* out, std::size_t channels)
{
    for (std::size_t x = 0; x < static_cast<std::size_t>(header.width); ++x, out += channels) {
        if (header.bits <= 8) {
            const std::size_t bit = x * header.bits;
            const unsigned index = row[bit / 8] >> (8 - header.bits - bit % 8) & ((1u << header.bits) - 1);
            set_color(header, index, out, channels);
        } else if (header.bits == 16) {
            const unsigned pixel = row[2 * x] | static_cast<unsigned>(row[2 * x + 1]) << 8;
            for (std::size_t c = 0; c < 3; ++c) out[c] = masked(pixel, header.masks[c]);
        } else {
            const Bytes pixel = row.subspan(x * header.bits / 8, header.bits / 8);
            out[0] = pixel[2];
            out[1] = pixel[1];
            out[2] = pixel[0];
            if (channels == 4) out[3] = pixel[3];
        }
    }
}

bool all_grey(const std::vector<Color>& palette)
{
    return std::all_of(palette.begin(), palette.end(),
                       [](const Color& c) { return c[0] == c[1] && c[1] == c[2]; });
}

} // namespace

Raster read_bmp(const std::string& name)
{
    const ImageFileBytes file(name);
    ByteReader reader(file.all());
    const Header header = read_header(reader);
    const bool grey = header.bits == 8 && all_grey(header.palette);
    const std::size_t channels = header.bits == 32 ? 4 : grey ? 1 : 3;
    Raster raster = make_raster(header.width, header.height, channels, 1);
    put(raster.metadata, "oiio:ColorSpace", "sRGB");
    const auto width = static_cast<std::size_t>(header.width);
    const std::size_t row_size = (width * header.bits + 31) / 32 * 4;
    reader.go_to(header.pixels_at);
    const bool encoded = header.compression == rle8 || header.compression == rle4;
    const Numbers numbers = encoded ? read_encoded(reader, header) : nullptr;
    for (int line = 0; line < header.height; ++line) {
        unsigned char* const out = raster.row(header.from_top ? line : header.height - 1 - line);
        if (!encoded) decode_row(header, reader.take(row_size), out, channels);
        for (std::size_t x = 0; encoded && x < width; ++x)
            set_color(header, numbers[static_cast<std::size_t>(line) * width + x], out + x * channels,
                      channels);
    }
    return raster;
}

} // namespace plumb::lean
