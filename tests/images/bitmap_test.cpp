// SPDX-License-Identifier: MIT

// BMP and TGA of the kinds that scenes have.

#include "images/modules.h"

#include <functional>

using namespace plumb;
using namespace plumb::test;

namespace {

void add(std::string& file, std::uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i) file += static_cast<char>(value >> 8 * i);
}

std::string random_bytes(std::size_t count)
{
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(random_bits());
    return bytes;
}

struct Bitmap {
    int width = 5;
    int height = 4; // negative: from the top
    std::uint32_t bits = 24;
    std::uint32_t compression = 0;
    bool grey_palette = false;
    std::string pixels = {}; // else random
    std::uint32_t header_size = 40;
    std::vector<std::uint32_t> masks = {};
};

std::string bmp(const Bitmap& bitmap)
{
    const std::size_t entries = bitmap.bits <= 8 ? std::size_t{1} << bitmap.bits : 0;
    const std::size_t row = (static_cast<std::size_t>(bitmap.width) * bitmap.bits + 31) / 32 * 4;
    const std::string pixels = bitmap.pixels.empty()
                                   ? random_bytes(row * static_cast<std::size_t>(std::abs(bitmap.height)))
                                   : bitmap.pixels;
    const bool is_old = bitmap.header_size == 12;
    const std::size_t palette_at =
        14 + bitmap.header_size + (bitmap.header_size == 40 ? 4 * bitmap.masks.size() : 0);
    const std::size_t pixels_at = palette_at + entries * (is_old ? 3 : 4);
    std::string file = "BM";
    add(file, static_cast<std::uint32_t>(pixels_at + pixels.size()), 4);
    add(file, 0, 4);
    add(file, static_cast<std::uint32_t>(pixels_at), 4);
    add(file, bitmap.header_size, 4);
    add(file, static_cast<std::uint32_t>(bitmap.width), is_old ? 2 : 4);
    add(file, static_cast<std::uint32_t>(bitmap.height), is_old ? 2 : 4);
    add(file, 1, 2);
    add(file, bitmap.bits, 2);
    if (!is_old) {
        add(file, bitmap.compression, 4);
        for (int i = 0; i < 5; ++i) add(file, 0, 4);
    }
    for (const std::uint32_t mask : bitmap.masks) add(file, mask, 4);
    file.resize(palette_at, '\0');
    for (std::size_t i = 0; i < entries; ++i) {
        const std::uint32_t color = random_bits();
        add(file, bitmap.grey_palette ? (color & 255) * 0x10101 : color & 0xffffff, is_old ? 3 : 4);
    }
    return file + pixels;
}

struct Targa {
    std::uint32_t type = 2;
    std::uint32_t bits = 24;
    std::uint32_t attributes = 0;
    std::uint32_t entry_bits = 0; // of a palette with 16 entries
    std::string pixels = {};      // else random
    int width = 6;
    int height = 5;
};

std::string tga(const Targa& targa)
{
    std::string file;
    add(file, 3, 1);
    add(file, targa.entry_bits > 0 ? 1 : 0, 1);
    add(file, targa.type, 1);
    add(file, 0, 2);
    add(file, targa.entry_bits > 0 ? 16 : 0, 2);
    add(file, targa.entry_bits, 1);
    add(file, 0, 4);
    add(file, static_cast<std::uint32_t>(targa.width), 2);
    add(file, static_cast<std::uint32_t>(targa.height), 2);
    add(file, targa.bits, 1);
    add(file, targa.attributes, 1);
    file += "id!";
    if (targa.entry_bits > 0) file += random_bytes(16 * ((targa.entry_bits + 7) / 8));
    const std::size_t pixels = static_cast<std::size_t>(targa.width) * static_cast<std::size_t>(targa.height);
    if (!targa.pixels.empty()) return file + targa.pixels;
    if (targa.entry_bits == 0) return file + random_bytes(pixels * ((targa.bits + 7) / 8));
    for (std::size_t i = 0; i < pixels; ++i) file += static_cast<char>(random_bits() % 16);
    return file;
}

// Packets of an encoded TGA file, with pixels of so many bytes.
std::string packets(std::size_t pixels, std::size_t size, std::uint32_t largest)
{
    std::string bytes;
    while (pixels > 0) {
        const bool is_run = random_bits() % 2 == 0;
        const std::size_t count = std::min<std::size_t>(pixels, 1 + random_bits() % 9);
        bytes += static_cast<char>((is_run ? 128 : 0) + count - 1);
        for (std::size_t i = 0; i < (is_run ? 1 : count) * size; ++i)
            bytes += static_cast<char>(random_bits() % (largest + 1));
        pixels -= count;
    }
    return bytes;
}

} // namespace

TEST_CASE("BMP of every depth", "[images][bitmap]")
{
    const TempDirectory directory;
    for (const int width : {1, 5, 8, 33})
        for (const int height : {4, -4})
            for (const std::uint32_t bits : {1u, 4u, 8u, 16u, 24u, 32u}) {
                CAPTURE(width, height, bits);
                check_same(directory.write("a.bmp", bmp({.width = width, .height = height, .bits = bits})),
                           Compare::pixels);
            }
    check_same(directory.write("a.bmp", bmp({.bits = 8, .grey_palette = true})), Compare::pixels);
    check_same(directory.write("a.bmp", bmp({.bits = 24, .header_size = 12})), Compare::pixels);
    check_same(directory.write("a.bmp", bmp({.bits = 24, .header_size = 108})), Compare::pixels);
    check_same(directory.write("a.bmp", bmp({.bits = 24, .header_size = 124})), Compare::pixels);
}

TEST_CASE("TGA of every type and depth", "[images][bitmap]")
{
    const TempDirectory directory;
    for (const std::uint32_t turned : {0u, 16u, 32u, 48u}) {
        const auto check = [&](Targa targa) {
            targa.attributes |= turned;
            CAPTURE(targa.type, targa.bits, targa.entry_bits, targa.attributes);
            check_same(directory.write("a.tga", tga(targa)), Compare::pixels);
        };
        check({.type = 2, .bits = 24});
        check({.type = 2, .bits = 16});
        check({.type = 2, .bits = 15});
        check({.type = 2, .bits = 32, .attributes = 8});
        check({.type = 2, .bits = 32});
        check({.type = 3, .bits = 8});
        for (const std::uint32_t entry : {16u, 24u, 32u}) check({.type = 1, .bits = 8, .entry_bits = entry});
        check({.type = 10, .bits = 24, .pixels = packets(30, 3, 255)});
        check({.type = 10, .bits = 32, .attributes = 8, .pixels = packets(30, 4, 255)});
        check({.type = 10, .bits = 16, .pixels = packets(30, 2, 255)});
        check({.type = 11, .bits = 8, .pixels = packets(30, 1, 255)});
        check({.type = 9, .bits = 8, .entry_bits = 24, .pixels = packets(30, 1, 15)});
    }
}
