// SPDX-License-Identifier: MIT
#pragma once

// A picture to look colours up in, for textures and environment light.

#include "plumb/math/color.h"

#include <filesystem>
#include <vector>

namespace plumb {

// Conventions. Texel (i, j) stands at x = i, y = j: where a picture's pixels are squares whose middles count,
// subtract 1/2 first. Row 0 is the top row.
class Bitmap {
public:
    enum class Rows { repeat, clamp }; // what lies above the first row and below the last; columns repeat

    // Throws Error if the file cannot be read or a value is not finite. factor multiplies every texel.
    Bitmap(const std::filesystem::path& path, bool decode_srgb, const Color& factor);

    int width() const { return width_; }
    int height() const { return height_; }
    const Color& texel(int x, int y) const
    {
        return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x)];
    }
    void clamp_negative(); // negative values become 0

    // Between the four texels around (x, y), each weighted by its nearness in x times that in y.
    Color bilinear(float x, float y, Rows rows) const;

    Color mean() const;
    float min_value() const;
    float max_value() const;
    std::uint64_t memory_bytes() const { return texels_.capacity() * sizeof(Color); }

private:
    int width_ = 0;
    int height_ = 0;
    std::vector<Color> texels_;
};

} // namespace plumb
