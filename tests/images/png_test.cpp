// SPDX-License-Identifier: MIT

// PNG of every kind, written by libpng.

#include "images/modules.h"

#include <png.h>

#include <cstdio>
#include <functional>

using namespace plumb;
using namespace plumb::test;

namespace {

struct Kind {
    int type;
    int depth;
    int interlace = PNG_INTERLACE_NONE;
};

using More = std::function<void(png_structp, png_infop)>;

// Of random pixels. `more` puts into the header what else there is to be.
std::filesystem::path write_png_file(const TempDirectory& directory, const Kind& kind, int width, int height,
                                     const More& more = {})
{
    const std::filesystem::path path = directory / "image.png";
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), kind.depth,
                 kind.type, kind.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (kind.type == PNG_COLOR_TYPE_PALETTE) {
        std::vector<png_color> palette(std::size_t{1} << kind.depth);
        for (png_color& color : palette) {
            const std::uint32_t bits = random_bits();
            color = {static_cast<png_byte>(bits), static_cast<png_byte>(bits >> 8),
                     static_cast<png_byte>(bits >> 16)};
        }
        png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    }
    if (more) more(png, info);
    png_write_info(png, info);
    const std::size_t row_size = png_get_rowbytes(png, info);
    std::vector<png_byte> bytes(row_size * static_cast<std::size_t>(height));
    for (png_byte& byte : bytes) byte = static_cast<png_byte>(random_bits());
    std::vector<png_bytep> rows;
    for (int y = 0; y < height; ++y) rows.push_back(bytes.data() + static_cast<std::size_t>(y) * row_size);
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(file);
    return path;
}

constexpr Kind kinds[] = {
    {PNG_COLOR_TYPE_GRAY, 1},        {PNG_COLOR_TYPE_GRAY, 2},       {PNG_COLOR_TYPE_GRAY, 4},
    {PNG_COLOR_TYPE_GRAY, 8},        {PNG_COLOR_TYPE_GRAY, 16},      {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
    {PNG_COLOR_TYPE_GRAY_ALPHA, 16}, {PNG_COLOR_TYPE_RGB, 8},        {PNG_COLOR_TYPE_RGB, 16},
    {PNG_COLOR_TYPE_RGB_ALPHA, 8},   {PNG_COLOR_TYPE_RGB_ALPHA, 16}, {PNG_COLOR_TYPE_PALETTE, 1},
    {PNG_COLOR_TYPE_PALETTE, 2},     {PNG_COLOR_TYPE_PALETTE, 4},    {PNG_COLOR_TYPE_PALETTE, 8}};

void set_text(png_structp png, png_infop info, const char* key, const char* value, int compression)
{
    png_text text{};
    text.compression = compression;
    text.key = const_cast<char*>(key);
    text.text = const_cast<char*>(value);
    png_set_text(png, info, &text, 1);
}

} // namespace

TEST_CASE("PNG of every type and depth", "[images][png]")
{
    const TempDirectory directory;
    for (Kind kind : kinds)
        for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
            kind.interlace = interlace;
            CAPTURE(kind.type, kind.depth, interlace);
            for (const auto& [width, height] : {std::pair(1, 1), {7, 5}, {33, 20}})
                check_same(write_png_file(directory, kind, width, height));
        }
}

TEST_CASE("PNG with a transparent colour, and with a palette of transparent ones", "[images][png]")
{
    const TempDirectory directory;
    for (const Kind& kind : kinds) {
        if (kind.type & PNG_COLOR_MASK_ALPHA) continue;
        CAPTURE(kind.type, kind.depth);
        check_same(write_png_file(directory, kind, 40, 30, [&](png_structp png, png_infop info) {
            png_byte alphas[] = {0, 77, 200};
            const int count = kind.depth == 1 ? 2 : 3;
            png_color_16 color{};
            color.red = color.green = color.blue = color.gray = 1;
            png_set_tRNS(png, info, alphas, kind.type == PNG_COLOR_TYPE_PALETTE ? count : 0, &color);
        }));
    }
}

TEST_CASE("PNG with chunks about colour, bits and place", "[images][png]")
{
    const TempDirectory directory;
    const Kind kind{PNG_COLOR_TYPE_RGB, 8};
    const auto check = [&](const More& more) { check_same(write_png_file(directory, kind, 9, 9, more)); };
    for (const double gamma : {0.45455, 1.0, 0.5556, 0.1})
        check([=](png_structp png, png_infop info) { png_set_gAMA(png, info, gamma); });
    check([](png_structp png, png_infop info) { png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL); });
    check([](png_structp png, png_infop info) {
        const png_color_8 bits{5, 6, 5, 5, 8};
        png_set_sBIT(png, info, &bits);
    });
    check([](png_structp png, png_infop info) { png_set_oFFs(png, info, 3, 4, PNG_OFFSET_PIXEL); });
    check([](png_structp png, png_infop info) { png_set_oFFs(png, info, -3, -4, PNG_OFFSET_PIXEL); });
    check([](png_structp png, png_infop info) { png_set_oFFs(png, info, 3, 4, PNG_OFFSET_MICROMETER); });
    check([](png_structp png, png_infop info) { png_set_pHYs(png, info, 2835, 2835, PNG_RESOLUTION_METER); });
    check([](png_structp png, png_infop info) { png_set_pHYs(png, info, 2, 1, PNG_RESOLUTION_UNKNOWN); });
    check([](png_structp png, png_infop info) {
        const png_color_16 color{0, 1, 2, 3, 4};
        png_set_bKGD(png, info, &color);
    });
    check([](png_structp png, png_infop info) {
        const png_time time{2026, 11, 2, 3, 4, 5};
        png_set_tIME(png, info, &time);
    });
}

TEST_CASE("PNG with texts", "[images][png]")
{
    const TempDirectory directory;
    check_same(write_png_file(directory, {PNG_COLOR_TYPE_GRAY, 8}, 3, 3, [](png_structp png, png_infop info) {
        set_text(png, info, "Description", "a ramp", PNG_TEXT_COMPRESSION_NONE);
        set_text(png, info, "Author", "nobody", PNG_TEXT_COMPRESSION_NONE);
        set_text(png, info, "Title", "", PNG_TEXT_COMPRESSION_NONE);
        set_text(png, info, "plumb:seed", "7", PNG_TEXT_COMPRESSION_zTXt);
        set_text(png, info, "Comment", "the first", PNG_TEXT_COMPRESSION_NONE);
        set_text(png, info, "comment", "and another", PNG_ITXT_COMPRESSION_NONE);
    }));
}
