// SPDX-License-Identifier: MIT

// Errors in false colours, above a bar that tells which colour is how much.

#include "compare/estimate.h"
#include "plumb/base/error.h"
#include "plumb/image/false_color.h"

#include <fmt/format.h>

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

// errors: NaN where a pixel is not finite. largest: what the lightest colour stands for.
Image draw(const std::vector<float>& errors, int width, int height, double largest)
{
    const int full_width = std::max(width, least_width);
    Image image(full_width, height + strip_height);
    for (int y = 0; y < image.full_height(); ++y)
        for (int x = 0; x < full_width; ++x) set(image, x, y, background);
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++i)
            set(image, x, y,
                std::isnan(errors[i]) ? not_finite_color
                                      : false_color(static_cast<double>(errors[i]) / largest));

    const int top = height + 3;
    for (int x = 0; x < full_width; ++x)
        for (int y = top; y < top + bar_height; ++y)
            set(image, x, y, false_color(static_cast<double>(x) / (full_width - 1)));
    const int text_y = top + bar_height + 3;
    const std::string middle = fmt::format("{:.3g}", largest / 2.0);
    const std::string end = fmt::format("{:.3g}", largest);
    draw_text(image, 1, text_y, "0");
    draw_text(image, (full_width - text_width(middle)) / 2, text_y, middle);
    draw_text(image, full_width - 1 - text_width(end), text_y, end);
    return image;
}

// The error that one pixel in 200 exceeds: single bright pixels do not make all others dark.
double nearly_largest(std::vector<float> errors)
{
    std::erase_if(errors, [](float error) { return std::isnan(error); });
    if (errors.empty()) return 1.0;
    const auto place = errors.begin() + static_cast<std::ptrdiff_t>((errors.size() - 1) * 199 / 200);
    std::nth_element(errors.begin(), place, errors.end());
    if (*place > 0.f) return static_cast<double>(*place);
    const float largest = *std::max_element(errors.begin(), errors.end());
    return largest > 0.f ? static_cast<double>(largest) : 1.0;
}

} // namespace

Image difference_image(const Image& image_a, const Image& image_b, const std::string& layer)
{
    CompareSettings options;
    options.layer = layer;
    const auto [a, b] = make_compared_images(image_a, image_b, options);
    check_comparable(a, b);
    std::vector<float> errors;
    errors.reserve(a.pixels());
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        float error = std::numeric_limits<float>::quiet_NaN();
        if (a.is_finite(i) && b.is_finite(i)) {
            error = 0.f;
            for (std::size_t channel = 0; channel < a.channels.size(); ++channel)
                error = std::max(error, std::abs(a.value(i, channel) - b.value(i, channel)));
        }
        errors.push_back(error);
    }
    return draw(errors, a.window.width, a.window.height, nearly_largest(errors));
}

Image flip_image(const Comparison& comparison)
{
    if (comparison.flip_map.empty()) throw Error("FLIP was not computed, so there is no map of it");
    return draw(comparison.flip_map, comparison.width, comparison.height, 1.0);
}

} // namespace plumb
