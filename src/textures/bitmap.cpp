// SPDX-License-Identifier: MIT

#include "textures/bitmap.h"

#include "plumb/base/error.h"
#include "plumb/image/image.h"
#include "plumb/model/texture.h"

#include <fmt/format.h>

namespace plumb {

Bitmap::Neighbours Bitmap::repeated(float x, int size)
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

Bitmap::Neighbours Bitmap::clamped(float x, int size)
{
    if (!(x > 0.f)) return {0, 0, 0.f};
    const float inside = std::min(x, static_cast<float>(size - 1));
    const int first = static_cast<int>(inside);
    return {first, std::min(first + 1, size - 1), inside - static_cast<float>(first)};
}

// The image, then its mirror image, and so on.
Bitmap::Neighbours Bitmap::mirrored(float x, int size)
{
    const Neighbours in_both = repeated(x, 2 * size);
    const auto unfolded = [size](int i) { return i < size ? i : 2 * size - 1 - i; };
    return {unfolded(in_both.first), unfolded(in_both.second), in_both.weight};
}

Bitmap::Neighbours Bitmap::wrapped(float x, int size, Wrap wrap)
{
    return wrap == Wrap::repeat   ? repeated(x, size)
           : wrap == Wrap::mirror ? mirrored(x, size)
                                  : clamped(x, size);
}

Bitmap::Bitmap(const std::filesystem::path& path, bool decode_srgb, const Color& factor)
{
    if (std::optional<ByteImage> bytes = read_byte_image(path)) {
        keep(*std::move(bytes), decode_srgb, factor);
        return;
    }
    const Image image = read_image(path, decode_srgb);
    const PixelRect& window = image.data_window();
    width_ = window.width;
    height_ = window.height;
    floats_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const Color color = image.color(window.x + x, window.y + y) * factor;
            if (!is_finite(color))
                throw Error(
                    fmt::format("cannot use '{}': pixel ({}, {}) is not finite", path.string(), x, y));
            floats_.push_back(color);
        }
    summarize();
}

void Bitmap::keep(ByteImage&& image, bool decode_srgb, const Color& factor)
{
    width_ = image.width;
    height_ = image.height;
    channels_ = image.channels;
    bytes_ = std::move(image.values);
    decoded_ = byte_values(decode_srgb);
    factor_ = factor;
    summarize();
}

void Bitmap::clamp_negative()
{
    const auto clamped_color = [](const Color& c) {
        return Color(std::max(c.r, 0.f), std::max(c.g, 0.f), std::max(c.b, 0.f));
    };
    for (Color& c : floats_) c = clamped_color(c);
    factor_ = clamped_color(factor_);
    summarize();
}

Color Bitmap::between(const Neighbours& column, const Neighbours& row) const
{
    const auto along = [&](int j) {
        return texel(column.first, j) * (1.f - column.weight) + texel(column.second, j) * column.weight;
    };
    return along(row.first) * (1.f - row.weight) + along(row.second) * row.weight;
}

Color Bitmap::bilinear(float x, float y, Rows rows) const
{
    return between(repeated(x, width_), rows == Rows::repeat ? repeated(y, height_) : clamped(y, height_));
}

Color Bitmap::bilinear(float x, float y, Wrap wrap) const
{
    return between(wrapped(x, width_, wrap), wrapped(y, height_, wrap));
}

Color Bitmap::nearest(float x, float y, Wrap wrap) const
{
    return texel(wrapped(x + 0.5f, width_, wrap).first, wrapped(y + 0.5f, height_, wrap).first);
}

Vec2f Bitmap::slope(float x, float y, Wrap wrap) const
{
    const Neighbours column = wrapped(x, width_, wrap), row = wrapped(y, height_, wrap);
    const auto number = [this](int i, int j) { return number_of(texel(i, j)); };
    const float upper_left = number(column.first, row.first), upper_right = number(column.second, row.first);
    const float lower_left = number(column.first, row.second);
    const float lower_right = number(column.second, row.second);
    return {lerp(upper_right - upper_left, lower_right - lower_left, row.weight),
            lerp(lower_left - upper_left, lower_right - upper_right, column.weight)};
}

// How often each byte occurs in a channel.
std::array<std::uint64_t, 256> Bitmap::histogram(int channel) const
{
    std::array<std::uint64_t, 256> counts{};
    const auto apart = static_cast<std::size_t>(channels_);
    for (std::size_t i = channels_ == 1 ? 0 : static_cast<std::size_t>(channel); i < bytes_.size();
         i += apart)
        ++counts[bytes_[i]];
    return counts;
}

void Bitmap::summarize()
{
    const double count = double(width_) * double(height_);
    double mean[3] = {0.0, 0.0, 0.0};
    min_value_ = infinity;
    max_value_ = -infinity;
    const auto include = [&](int channel, float value, double share) {
        mean[channel] += value * share;
        min_value_ = std::min(min_value_, value);
        max_value_ = std::max(max_value_, value);
    };
    for (const Color& c : floats_)
        for (int i = 0; i < 3; ++i) include(i, c[i], 1.0);
    for (int i = 0; floats_.empty() && i < 3; ++i) {
        const auto counts = histogram(i);
        for (std::size_t byte = 0; byte < counts.size(); ++byte)
            if (counts[byte] > 0) include(i, decoded_[byte] * factor_[i], double(counts[byte]));
    }
    mean_ = Color(static_cast<float>(mean[0] / count), static_cast<float>(mean[1] / count),
                  static_cast<float>(mean[2] / count));
}

} // namespace plumb
