// SPDX-License-Identifier: MIT
#pragma once

// Images of 32-bit words, for what must not be rounded: .exr files with integer channels beside those of floats, which
// are there to be looked at.

#include "plumb/image/image.h"

#include <cstdint>
#include <functional>
#include <span>

namespace plumb {

struct WordImage {
    PixelRect data;
    int full_width = 0;
    int full_height = 0;
    std::vector<std::string> float_channels; // they come first
    std::vector<std::string> word_channels;
    Metadata metadata;

    std::size_t words_per_row() const
    {
        return static_cast<std::size_t>(data.width) * (float_channels.size() + word_channels.size());
    }
};

// Rows from the top, each from the left: for each pixel the bits of its floats, then its words; or those of the channels
// chosen.
using FillRows = std::function<void(int top, int count, std::span<std::uint32_t> rows)>;
using UseRow = std::function<void(int y, std::span<const std::uint32_t> row)>;

// What the file will hold. Throws Error with the reason if memory is short.
std::vector<unsigned char> encode_words(const WordImage& image, const FillRows& fill);

// choose() is given what the header says, before the first row, and answers which channels the rows are to have, in that
// order. Throws Error with the reason, what they throw included.
using ChooseChannels = std::function<std::vector<std::string>(const WordImage&)>;
void read_words(const std::filesystem::path& path, const ChooseChannels& choose, const UseRow& use);

} // namespace plumb
