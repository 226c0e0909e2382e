// SPDX-License-Identifier: MIT

// Numbers of documents: see plumb/display/terminal_picture.h.

#include "plumb/display/terminal_picture.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace plumb {

namespace {

using Rgb = std::array<std::uint8_t, 3>;

Rgb pixel_of(const ByteImage& image, int x, int y)
{
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                static_cast<std::size_t>(x));
    return {image.values[at], image.values[at + 1], image.values[at + 2]};
}

// From 1 to 31, of 32: Bayer's matrix.
int dither_threshold(int x, int y)
{
    constexpr int matrix[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    return 2 * matrix[y & 3][x & 3] + 1;
}

// One of xterm's 24 greys, 8 to 238, for what has hardly any colour; else of its 6x6x6 colours, dithered.
int xterm_color(const Rgb& color, int x, int y)
{
    const auto [least, most] = std::minmax({color[0], color[1], color[2]});
    constexpr int hardly = 6;
    if (most - least < hardly && most <= 238 && least >= 8)
        return 232 + std::clamp((most - 8 + 5) / 10, 0, 23);
    const int threshold = dither_threshold(x, y);
    const auto level = [threshold](int value) {
        constexpr int levels[] = {0, 95, 135, 175, 215, 255};
        int below = 0;
        while (below < 4 && levels[below + 1] <= value) ++below;
        return below +
               ((value - levels[below]) * 32 > threshold * (levels[below + 1] - levels[below]) ? 1 : 0);
    };
    return 16 + 36 * level(color[0]) + 6 * level(color[1]) + level(color[2]);
}

// ground: 38 or 48. Of the pixel at x, y.
std::string color_code(const ByteImage& image, int x, int y, int ground, bool true_color)
{
    const Rgb color = pixel_of(image, x, y);
    return true_color ? fmt::format("\033[{};2;{};{};{}m", ground, color[0], color[1], color[2])
                      : fmt::format("\033[{};5;{}m", ground, xterm_color(color, x, y));
}

std::string base64(const std::vector<std::uint8_t>& bytes)
{
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < left ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// Of 6x6x6 colours at equal steps, dithered.
int dithered_color(const Rgb& color, int x, int y)
{
    const int threshold = dither_threshold(x, y);
    const auto level = [threshold](int value) {
        return std::min(5, (value * 5 * 32 / 255 + threshold) / 32);
    };
    return 36 * level(color[0]) + 6 * level(color[1]) + level(color[2]);
}

// A run of one sixel: itself, or from four on its number.
void add_run(std::string& text, char sixel, int count)
{
    if (count > 3)
        text += fmt::format("!{}{}", count, sixel);
    else
        text.append(static_cast<std::size_t>(count), sixel);
}

} // namespace

std::string half_blocks(const ByteImage& image, bool true_color)
{
    std::string text;
    for (int y = 0; y < image.height; y += 2) {
        std::string upper, lower; // what the terminal has
        for (int x = 0; x < image.width; ++x) {
            const bool has_lower = y + 1 < image.height;
            const std::string front = color_code(image, x, y, 38, true_color);
            const std::string back =
                has_lower ? color_code(image, x, y + 1, 48, true_color) : std::string("\033[49m");
            if (front != upper) text += front;
            if (back != lower) text += back;
            text += "\u2580"; // the upper half of a block
            upper = front;
            lower = back;
        }
        text += "\033[0m\033[K\r\n";
    }
    return text;
}

std::string kitty(const ByteImage& image, int columns, int rows)
{
    constexpr std::size_t largest_chunk = 4096; // [1], "Remote client"
    constexpr int id = 14158;                   // an image of the same id replaces the one before
    const std::string data = base64(image.values);
    std::string text;
    for (std::size_t begin = 0; begin < data.size(); begin += largest_chunk) {
        const bool more = begin + largest_chunk < data.size();
        const std::string keys = begin == 0
                                     ? fmt::format("a=T,f=24,s={},v={},c={},r={},i={},p=1,q=2,C=1,m={}",
                                                   image.width, image.height, columns, rows, id, more ? 1 : 0)
                                     : fmt::format("m={}", more ? 1 : 0);
        text += fmt::format("\033_G{};{}\033\\", keys, data.substr(begin, largest_chunk));
    }
    return text;
}

std::string sixel(const ByteImage& image)
{
    // Pixels that are not set stay as they are; then the aspect ratio and the size.
    std::string text = fmt::format("\0337\033P0;1;0q\"1;1;{};{}", image.width, image.height);
    for (int i = 0; i < 216; ++i)
        text += fmt::format("#{};2;{};{};{}", i, i / 36 * 20, i / 6 % 6 * 20, i % 6 * 20);
    const auto width = static_cast<std::size_t>(image.width);
    for (int top = 0; top < image.height; top += 6) {
        const int rows = std::min(6, image.height - top);
        // Of each colour in the band, its sixels.
        std::array<std::vector<std::uint8_t>, 216> bands;
        for (int y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const int column = static_cast<int>(x);
                auto& band = bands[static_cast<std::size_t>(
                    dithered_color(pixel_of(image, column, top + y), column, top + y))];
                if (band.empty()) band.resize(width);
                band[x] = static_cast<std::uint8_t>(band[x] | 1 << y);
            }
        for (std::size_t color = 0; color < bands.size(); ++color) {
            if (bands[color].empty()) continue;
            text += fmt::format("#{}", color);
            for (std::size_t x = 0; x < width;) {
                std::size_t end = x;
                while (end < width && bands[color][end] == bands[color][x]) ++end;
                add_run(text, static_cast<char>('?' + bands[color][x]), static_cast<int>(end - x));
                x = end;
            }
            text += '$'; // back to the band's begin
        }
        text += '-'; // the next band
    }
    return text + "\033\\\0338";
}

} // namespace plumb
