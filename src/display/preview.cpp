// SPDX-License-Identifier: MIT
#include "plumb/display/preview.h"

#include "plumb/image/development.h"

#include <algorithm>
#include <cmath>

namespace plumb {

namespace {

struct Size {
    int width;
    int height;
};

Size largest_inside(const PixelRect& window, int most_columns, int most_rows)
{
    const double scale = std::min({1.0, static_cast<double>(most_columns) / window.width,
                                   static_cast<double>(most_rows) / window.height});
    const auto scaled = [scale](int side, int most) {
        return std::clamp(static_cast<int>(std::lround(side * scale)), 1, std::max(most, 1));
    };
    return {scaled(window.width, most_columns), scaled(window.height, most_rows)};
}

// The pixels from first to before last that the small pixel covers: at least one.
struct Range {
    int first;
    int last;
};

Range covered(int pixel, int small, int large)
{
    const auto place = [&](int i) { return static_cast<int>(static_cast<std::int64_t>(i) * large / small); };
    return {place(pixel), std::max(place(pixel + 1), place(pixel) + 1)};
}

} // namespace

Preview::Preview(const PixelRect& window, const Development& development)
    : window_(window),
      development_(development),
      values_(3 * static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height))
{}

void Preview::update(const PixelRect& part, std::span<const float> values, std::size_t channels)
{
    const std::lock_guard lock(mutex_);
    const float* in = values.data();
    for (int y = part.y; y < part.y + part.height; ++y) {
        const auto row = static_cast<std::size_t>(y - window_.y),
                   column = static_cast<std::size_t>(part.x - window_.x);
        float* out = values_.data() + 3 * (row * static_cast<std::size_t>(window_.width) + column);
        for (int x = 0; x < part.width; ++x, in += channels, out += 3) std::copy(in, in + 3, out);
    }
}

ByteImage Preview::picture(int most_columns, int most_rows) const
{
    const auto [width, height] = largest_inside(window_, most_columns, most_rows);
    const Developer develop(development_);
    ByteImage image{width, height, 3, {}};
    image.values.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const std::lock_guard lock(mutex_);
    for (int y = 0; y < height; ++y) {
        const Range rows = covered(y, height, window_.height);
        for (int x = 0; x < width; ++x) {
            const Range columns = covered(x, width, window_.width);
            Color sum;
            for (int row = rows.first; row < rows.last; ++row)
                for (int column = columns.first; column < columns.last; ++column) {
                    const float* const value =
                        values_.data() +
                        3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(window_.width) +
                             static_cast<std::size_t>(column));
                    sum += Color(value[0], value[1], value[2]);
                }
            const auto count = static_cast<float>((rows.last - rows.first) * (columns.last - columns.first));
            const Color shown = develop(sum / count);
            for (int c = 0; c < 3; ++c)
                image.values.push_back(static_cast<std::uint8_t>(shown[c] * 255.f + 0.5f));
        }
    }
    return image;
}

} // namespace plumb
