// SPDX-License-Identifier: MIT
#include "reports/image_data.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumb {

namespace {

std::array<unsigned char, 4> shared_exponent(const Color& color)
{
    if (!std::isfinite(color.r) || !std::isfinite(color.g) || !std::isfinite(color.b)) return {0, 0, 0, 255};
    const float largest = std::max({color.r, color.g, color.b});
    int exponent = 0;
    std::frexp(largest, &exponent); // largest is in [2^(exponent - 1), 2^exponent)
    if (!(largest > 0.f) || exponent < -126) return {0, 0, 0, 0};
    exponent = std::min(exponent, 126);
    const auto mantissa = [&](float x) {
        return static_cast<unsigned char>(std::clamp(std::ldexp(x, 8 - exponent), 0.f, 255.f));
    };
    return {mantissa(color.r), mantissa(color.g), mantissa(color.b),
            static_cast<unsigned char>(exponent + 128)};
}

} // namespace

std::string base64(std::string_view bytes)
{
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(bytes.size() - i, 3);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

int reduced_size(int pixels, int reduction)
{
    return (pixels + reduction - 1) / reduction;
}

std::string shared_exponent_bytes(const Image& image, int reduction)
{
    const PixelRect& window = image.data_window();
    const int right = window.x + window.width, bottom = window.y + window.height;
    std::string bytes;
    for (int top = window.y; top < bottom; top += reduction) {
        for (int left = window.x; left < right; left += reduction) {
            Color sum(0.f);
            int count = 0;
            for (int y = top; y < std::min(top + reduction, bottom); ++y)
                for (int x = left; x < std::min(left + reduction, right); ++x, ++count)
                    sum += image.color(x, y);
            for (const unsigned char byte : shared_exponent(sum / static_cast<float>(count)))
                bytes += static_cast<char>(byte);
        }
    }
    return bytes;
}

} // namespace plumb
