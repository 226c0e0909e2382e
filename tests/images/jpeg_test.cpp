// SPDX-License-Identifier: MIT

// JPEG of every kind, written by libjpeg.

#include "images/modules.h"

#include <cstdio> // jpeglib.h needs it before

#include <jpeglib.h>

using namespace plumb;
using namespace plumb::test;

namespace {

struct Kind {
    J_COLOR_SPACE colors = JCS_RGB;
    int channels = 3;
    int across = 1; // samples of brightness for one of colour
    int down = 1;
    bool progressive = false;
    bool adobe = false;
    std::string comment = {};
};

std::filesystem::path write_jpeg_file(const TempDirectory& directory, const Kind& kind, int width, int height)
{
    const std::filesystem::path path = directory / "image.jpg";
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    jpeg_error_mgr errors{};
    jpeg_compress_struct info{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    jpeg_stdio_dest(&info, file);
    info.image_width = static_cast<JDIMENSION>(width);
    info.image_height = static_cast<JDIMENSION>(height);
    info.input_components = kind.channels;
    info.in_color_space = kind.colors;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, 90, TRUE);
    if (kind.channels == 3) {
        info.comp_info[0].h_samp_factor = kind.across;
        info.comp_info[0].v_samp_factor = kind.down;
    }
    if (kind.progressive) jpeg_simple_progression(&info);
    if (kind.adobe) info.write_Adobe_marker = TRUE;
    jpeg_start_compress(&info, TRUE);
    if (!kind.comment.empty())
        jpeg_write_marker(&info, JPEG_COM, reinterpret_cast<const JOCTET*>(kind.comment.data()),
                          static_cast<unsigned>(kind.comment.size()));
    std::vector<JSAMPLE> row(static_cast<std::size_t>(width * kind.channels));
    for (int y = 0; y < height; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = static_cast<JSAMPLE>(i * 3 + static_cast<std::size_t>(y) * 5 + random_bits() % 32);
        JSAMPROW rows[] = {row.data()};
        jpeg_write_scanlines(&info, rows, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    std::fclose(file);
    return path;
}

} // namespace

TEST_CASE("JPEG of every kind", "[images][jpeg]")
{
    const TempDirectory directory;
    for (const bool progressive : {false, true})
        for (const auto& [width, height] : {std::pair(1, 1), {17, 9}, {64, 48}}) {
            CAPTURE(progressive, width, height);
            const auto check = [&](Kind kind) {
                kind.progressive = progressive;
                CAPTURE(kind.colors, kind.across, kind.down, kind.adobe);
                check_same(write_jpeg_file(directory, kind, width, height), Compare::pixels);
            };
            check({JCS_GRAYSCALE, 1});
            for (const auto& [across, down] : {std::pair(1, 1), {2, 1}, {2, 2}, {1, 2}, {4, 1}})
                check({JCS_RGB, 3, across, down});
            check({JCS_CMYK, 4});
            check({JCS_CMYK, 4, 1, 1, false, true});
        }
}

TEST_CASE("what JPEG files say of themselves", "[images][jpeg]")
{
    const TempDirectory directory;
    check_same(write_jpeg_file(directory, {JCS_RGB, 3, 2, 2}, 16, 16));
    check_same(write_jpeg_file(directory, {.comment = "a comment"}, 16, 16));
    check_same(write_jpeg_file(directory, {.comment = std::string("zero\0inside", 11)}, 16, 16));
    CHECK(lean().jpeg_decoder().starts_with("jpeg-turbo "));
    CHECK_THAT(with_openimageio().jpeg_decoder(), ContainsSubstring("jpeg"));
}
