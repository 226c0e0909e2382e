// SPDX-License-Identifier: MIT
#pragma once

// Images as text, for fuzz targets: what a codec makes of a file, written down. Every text is one; what makes no sense
// is skipped.
//
//     window 0 0 2 1 of 4 4          x, y, width, height; then the size of the full image
//     floats R G B                   the channels of floats
//     words count                    those of 32-bit integers, which come behind them
//     levels 256                     the values were integers (DecodedImage::integer_levels)
//     int plumb:state 2              of the header, one a line
//     text plumb:inputs 00 a.xml\n01 b.obj
//     float plumb:envmapScale 0.5
//     list worldToCamera 1 0 0 0
//     pixels
//     ....                           32-bit values, pixel by pixel, the lowest byte first; those that are missing are 0
//
// A line `next` ends an image that is followed by another.

#include "image/image_words.h"

#include <string>
#include <string_view>
#include <vector>

namespace plumb::fuzz {

struct TextImage {
    PixelRect data{0, 0, 1, 1};
    int full_width = 1;
    int full_height = 1;
    std::vector<std::string> floats;
    std::vector<std::string> words;
    std::size_t integer_levels = 0;
    Metadata metadata;
    std::string values; // as in the file

    std::size_t channels() const { return floats.size() + words.size(); }
    std::size_t size() const; // how many values the window has
    std::uint32_t value(std::size_t index) const;
};

TextImage parse_image(std::string_view text);
std::string image_text(const TextImage& image);

// The texts of the images in one, of which there is at least one.
std::vector<std::string_view> split_images(std::string_view text);
inline constexpr std::string_view image_separator = "\nnext\n";

// What was asked for and handed over when an image of words was read last (text_images.cpp).
struct WordsRead {
    std::vector<std::string> channels;
    std::vector<std::vector<std::uint32_t>> rows;
};
const WordsRead& words_read();
void forget_words_read();

} // namespace plumb::fuzz
