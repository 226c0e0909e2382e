// SPDX-License-Identifier: MIT

// Truevision's images.
//
// [1] "Truevision TGA File Format Specification", version 2.0, 1991

#include "image/bytes.h"
#include "image/lean/codecs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace plumb::lean {

namespace {

enum class Kind { palette = 1, color = 2, grey = 3 };

struct Header { // [1], table 1
    Kind kind{};
    bool encoded = false;
    unsigned first_entry = 0; // of the palette
    unsigned entries = 0;
    unsigned entry_bits = 0;
    int width = 0;
    int height = 0;
    unsigned bits = 0; // of a pixel
    unsigned alpha_bits = 0;
    bool from_right = false;
    bool from_top = false;
    bool has_palette = false;
};

Header read_header(ByteReader& reader)
{
    Header header;
    const unsigned id_length = reader.byte();
    header.has_palette = reader.byte() != 0;
    const unsigned type = reader.byte();
    header.first_entry = reader.number16();
    header.entries = reader.number16();
    header.entry_bits = reader.byte();
    reader.take(4); // where the image is on a screen
    header.width = static_cast<int>(reader.number16());
    header.height = static_cast<int>(reader.number16());
    header.bits = reader.byte();
    const unsigned attributes = reader.byte();
    reader.take(id_length);

    header.encoded = (type & 8) != 0;
    const unsigned kind = type & ~8u;
    if (kind == 0) throw Error("Image with no data");
    if (kind > 3) throw Error(fmt::format("Illegal image type: {}", type));
    header.kind = static_cast<Kind>(kind);
    header.alpha_bits = attributes & 15;
    header.from_right = (attributes & 16) != 0;
    header.from_top = (attributes & 32) != 0;
    return header;
}

// Of a pixel or a palette entry of colour.
bool is_color_size(unsigned bits)
{
    return bits == 15 || bits == 16 || bits == 24 || bits == 32;
}

void check(const Header& header)
{
    const bool good = header.kind == Kind::color     ? is_color_size(header.bits)
                      : header.kind == Kind::palette ? header.bits == 8 || header.bits == 16
                                                     : header.bits == 8;
    if (!good) throw Error(fmt::format("Illegal pixel size: {} bits per pixel", header.bits));
    if (header.kind != Kind::palette) return;
    if (!header.has_palette) throw Error("it lacks its palette");
    if (!is_color_size(header.entry_bits))
        throw Error(fmt::format("Illegal palette entry size: {} bits", header.entry_bits));
}

using Color = std::array<unsigned char, 4>;

std::size_t bytes_of(unsigned bits)
{
    return (bits + 7) / 8;
}

// Of 5 bits.
unsigned char widened(unsigned value)
{
    return static_cast<unsigned char>(value << 3 | value >> 2);
}

Color color_of(Bytes bytes, unsigned bits)
{
    if (bytes.size() == 1) return {bytes[0], bytes[0], bytes[0], 255};
    if (bytes.size() == 2) {
        const unsigned value = bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
        return {widened(value >> 10 & 31), widened(value >> 5 & 31), widened(value & 31), 255};
    }
    return {bytes[2], bytes[1], bytes[0], bits == 32 ? bytes[3] : static_cast<unsigned char>(255)};
}

std::vector<Color> read_palette(ByteReader& reader, const Header& header)
{
    const std::size_t size = bytes_of(header.entry_bits);
    if (!header.has_palette) return {};
    std::vector<Color> palette;
    for (unsigned i = 0; i < header.entries; ++i)
        palette.push_back(color_of(reader.take(size), header.entry_bits));
    return palette;
}

Color color_of(Bytes bytes, const Header& header, const std::vector<Color>& palette)
{
    if (header.kind != Kind::palette) return color_of(bytes, header.bits);
    const unsigned index = bytes[0] | (bytes.size() > 1 ? static_cast<unsigned>(bytes[1]) << 8 : 0u);
    if (index < header.first_entry || index - header.first_entry >= palette.size())
        throw Error(fmt::format("the palette has no entry {}", index));
    return palette[index - header.first_entry];
}

void read_pixels(ByteReader& reader, const Header& header, const std::vector<Color>& palette,
                 const Raster& raster)
{
    const std::size_t channels = raster.channels.size();
    const std::size_t size = bytes_of(header.bits);
    const auto width = static_cast<std::size_t>(header.width);
    const std::size_t pixels = width * static_cast<std::size_t>(header.height);
    std::size_t in_packet = 0; // pixels that are still to come of it
    bool is_run = false;
    Color color{};
    for (std::size_t i = 0; i < pixels; ++i) {
        const bool begins = in_packet == 0;
        if (begins) {
            const unsigned code = header.encoded ? reader.byte() : 0;
            is_run = code >= 128;
            in_packet = (code & 127) + 1;
        }
        if (begins || !is_run) color = color_of(reader.take(size), header, palette);
        --in_packet;
        const std::size_t x = header.from_right ? width - 1 - i % width : i % width;
        const auto line = static_cast<int>(i / width);
        const int y = header.from_top ? line : header.height - 1 - line;
        std::copy_n(color.data(), channels, raster.row(y) + x * channels);
    }
}

} // namespace

Raster read_tga(const std::string& name)
{
    const ImageFileBytes file(name);
    ByteReader reader(file.all());
    const Header header = read_header(reader);
    check(header);
    const bool has_alpha = header.kind == Kind::color && header.bits == 32;
    const std::size_t channels = header.kind == Kind::grey ? 1 : has_alpha ? 4 : 3;
    Raster raster = make_raster(header.width, header.height, channels, 1);
    const std::vector<Color> palette = read_palette(reader, header);
    read_pixels(reader, header, palette, raster);
    put(raster.metadata, "oiio:ColorSpace", "sRGB");
    return raster;
}

} // namespace plumb::lean
