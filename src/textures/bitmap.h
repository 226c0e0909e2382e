// SPDX-License-Identifier: MIT
#pragma once

// An image to look colours up in, for textures and environment light.

#include "plumb/math/color.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace plumb {

struct ByteImage;

// Conventions. Texel (i, j) stands at x = i, y = j: where an image's pixels are squares whose middles count,
// subtract 1/2 first. Row 0 is the top row. Images of 8-bit integers keep 8 bits a channel.
class Bitmap {
public:
    enum class Rows { repeat, clamp }; // what lies above the first row and below the last; columns repeat
    enum class Wrap { repeat, mirror, clamp };

    // Throws Error if the file cannot be read or a value is not finite. factor multiplies every texel.
    Bitmap(const std::filesystem::path& path, bool decode_srgb, const Color& factor);

    int width() const { return width_; }
    int height() const { return height_; }
    Color texel(int x, int y) const
    {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
        if (!floats_.empty()) return floats_[i];
        if (channels_ == 1) return Color(decoded_[bytes_[i]]) * factor_;
        return Color(decoded_[bytes_[3 * i]], decoded_[bytes_[3 * i + 1]], decoded_[bytes_[3 * i + 2]]) *
               factor_;
    }
    void clamp_negative(); // negative values become 0

    // Between the four texels around (x, y), each weighted by its nearness in x times that in y.
    Color bilinear(float x, float y, Rows rows) const;
    Color bilinear(float x, float y, Wrap wrap) const;
    Color nearest(float x, float y, Wrap wrap) const; // the texel whose square holds (x, y)
    // The derivatives by x and y of bilinear() read as a number.
    Vec2f slope(float x, float y, Wrap wrap) const;

    Color mean() const { return mean_; }
    float min_value() const { return min_value_; }
    float max_value() const { return max_value_; }
    std::uint64_t memory_bytes() const { return floats_.capacity() * sizeof(Color) + bytes_.capacity(); }

private:
    // Two neighbours of a coordinate, and the weight of the second.
    struct Neighbours {
        int first;
        int second;
        float weight;
    };
    static Neighbours repeated(float x, int size);
    static Neighbours clamped(float x, int size);
    static Neighbours mirrored(float x, int size);
    static Neighbours wrapped(float x, int size, Wrap wrap);
    Color between(const Neighbours& column, const Neighbours& row) const;
    std::array<std::uint64_t, 256> histogram(int channel) const;
    void summarize();
    void keep(ByteImage&& image, bool decode_srgb, const Color& factor);

    int width_ = 0;
    int height_ = 0;
    std::vector<Color> floats_; // either these
    std::vector<std::uint8_t>
        bytes_; // or these, channels_ to a texel, which stand for decoded_[byte] factor_
    int channels_ = 3;
    std::array<float, 256> decoded_{};
    Color factor_;
    Color mean_;
    float min_value_ = 0.f;
    float max_value_ = 0.f;
};

} // namespace plumb
