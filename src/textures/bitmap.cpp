// SPDX-License-Identifier: MIT

#include "textures/bitmap.h"

#include "plumb/base/error.h"
#include "plumb/image/image.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// Two neighbours of a coordinate in [0, size), and the weight of the second.
struct Neighbours {
    int first;
    int second;
    float weight;
};

Neighbours repeated(float x, int size)
{
    // In double, because x may be far from the first period.
    const double length = size;
    const double inside = x - std::floor(x / length) * length;
    const int first =
        inside >= 0.0 && inside < length ? static_cast<int>(inside) : 0; // 0: rounded up, not a number
    const double fraction = inside - first;
    const float weight = fraction >= 0.0 && fraction <= 1.0 ? static_cast<float>(fraction) : 0.f;
    return {first, first + 1 < size ? first + 1 : 0, weight};
}

Neighbours clamped(float x, int size)
{
    const float last = static_cast<float>(size - 1);
    const float inside = x > 0.f ? std::min(x, last) : 0.f;
    const int first = static_cast<int>(inside);
    return {first, std::min(first + 1, size - 1), inside - static_cast<float>(first)};
}

} // namespace

Bitmap::Bitmap(const std::filesystem::path& path, bool decode_srgb, const Color& factor)
{
    const Image image = read_image(path, decode_srgb);
    const PixelRect& window = image.data_window();
    width_ = window.width;
    height_ = window.height;
    texels_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const Color color = image.color(window.x + x, window.y + y) * factor;
            if (!is_finite(color))
                throw Error(
                    fmt::format("cannot use '{}': pixel ({}, {}) is not finite", path.string(), x, y));
            texels_.push_back(color);
        }
}

void Bitmap::clamp_negative()
{
    for (Color& c : texels_) c = Color(std::max(c.r, 0.f), std::max(c.g, 0.f), std::max(c.b, 0.f));
}

Color Bitmap::bilinear(float x, float y, Rows rows) const
{
    const Neighbours column = repeated(x, width_);
    const Neighbours row = rows == Rows::repeat ? repeated(y, height_) : clamped(y, height_);
    const auto along = [&](int j) {
        return texel(column.first, j) * (1.f - column.weight) + texel(column.second, j) * column.weight;
    };
    return along(row.first) * (1.f - row.weight) + along(row.second) * row.weight;
}

Color Bitmap::mean() const
{
    double sum[3] = {0.0, 0.0, 0.0};
    for (const Color& c : texels_)
        for (int i = 0; i < 3; ++i) sum[i] += c[i];
    const auto count = static_cast<double>(texels_.size());
    return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
            static_cast<float>(sum[2] / count)};
}

float Bitmap::min_value() const
{
    float smallest = infinity;
    for (const Color& c : texels_) smallest = std::min(smallest, min_component(c));
    return smallest;
}

float Bitmap::max_value() const
{
    float largest = -infinity;
    for (const Color& c : texels_) largest = std::max(largest, max_component(c));
    return largest;
}

} // namespace plumb
