// SPDX-License-Identifier: MIT

#include "compare/false_color_image.h"

#include "plumb/image/false_color.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace plumb {

namespace {

constexpr int bar_height = 8;
constexpr int strip_height = 22; // bar and numbers
constexpr int glyph_width = 3;
constexpr int glyph_height = 5;
constexpr int least_width = 96; // room for the numbers
constexpr Color background(0.02f);

// Five rows of three pixels, from the top; '#' is lit.
std::string_view glyph(char c)
{
    switch (c) {
    case '0': return "####.##.##.####";
    case '1': return ".#.##..#..#.###";
    case '2': return "###..#####..###";
    case '3': return "###..####..####";
    case '4': return "#.##.####..#..#";
    case '5': return "####..###..####";
    case '6': return "####..####.####";
    case '7': return "###..#..#..#..#";
    case '8': return "####.#####.####";
    case '9': return "####.####..####";
    case '.': return ".............#.";
    case '-': return "......###......";
    case '+': return "....#.###.#....";
    case 'e': return "...####.##..###";
    default: return "...............";
    }
}

void set(Image& image, int x, int y, const Color& color)
{
    if (x < 0 || y < 0 || x >= image.full_width() || y >= image.full_height()) return;
    float* const pixel = image.pixel(x, y);
    for (int channel = 0; channel < 3; ++channel) pixel[channel] = color[channel];
}

int text_width(std::string_view text)
{
    return static_cast<int>(text.size()) * (glyph_width + 1) - 1;
}

void draw_text(Image& image, int x, int y, std::string_view text)
{
    for (const char c : text) {
        const std::string_view dots = glyph(c);
        for (int i = 0; i < glyph_width * glyph_height; ++i)
            if (dots[static_cast<std::size_t>(i)] == '#')
                set(image, x + i % glyph_width, y + i / glyph_width, Color(0.8f));
        x += glyph_width + 1;
    }
}

} // namespace

Image false_color_image(std::span<const float> values, int width, int height, const FalseColorScale& scale)
{
    const int full_width = std::max(width, least_width);
    Image image(full_width, height + strip_height);
    for (int y = 0; y < image.full_height(); ++y)
        for (int x = 0; x < full_width; ++x) set(image, x, y, background);
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++i)
            set(image, x, y,
                std::isnan(values[i]) ? not_finite_color : false_color(static_cast<double>(values[i])));

    const int top = height + 3;
    for (int x = 0; x < full_width; ++x)
        for (int y = top; y < top + bar_height; ++y)
            set(image, x, y, false_color(static_cast<double>(x) / (full_width - 1)));
    const int text_y = top + bar_height + 3;
    draw_text(image, 1, text_y, scale.low);
    draw_text(image, (full_width - text_width(scale.middle)) / 2, text_y, scale.middle);
    draw_text(image, full_width - 1 - text_width(scale.high), text_y, scale.high);
    return image;
}

} // namespace plumb
