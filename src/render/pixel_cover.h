// SPDX-License-Identifier: MIT
#pragma once

// Which pixels of a window some of many rectangles cover.

#include "plumb/image/image.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb {

inline std::size_t pixel_count(const PixelRect& window)
{
    return static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
}

// Row by row.
inline std::size_t index_in(const PixelRect& window, Vec2i pixel)
{
    return static_cast<std::size_t>(pixel.y - window.y) * static_cast<std::size_t>(window.width) +
           static_cast<std::size_t>(pixel.x - window.x);
}

// The union of any number of rectangles of pixels, in time that does not depend on their sizes: how their number changes from pixel to
// pixel, along both axes (Crow 1984, "Summed-Area Tables for Texture Mapping", the other way round).
class PixelCover {
public:
    explicit PixelCover(const PixelRect& window) : window_(window) {}

    bool empty() const { return changes_.empty(); }

    void add(const PixelRect& part)
    {
        if (part.width == 0 || part.height == 0) return;
        if (changes_.empty())
            changes_.resize((static_cast<std::size_t>(window_.width) + 1) *
                            (static_cast<std::size_t>(window_.height) + 1));
        ++change_at(part.x, part.y);
        --change_at(part.x + part.width, part.y);
        --change_at(part.x, part.y + part.height);
        ++change_at(part.x + part.width, part.y + part.height);
    }

    std::vector<bool> covered() const
    {
        std::vector<bool> result(pixel_count(window_));
        if (empty()) return result;
        const auto width = static_cast<std::size_t>(window_.width);
        std::vector<std::int64_t> above(width + 1); // the sums of the columns so far
        for (std::size_t y = 0; y < static_cast<std::size_t>(window_.height); ++y) {
            std::int64_t count = 0;
            for (std::size_t x = 0; x < width; ++x) {
                above[x] += changes_[y * (width + 1) + x];
                count += above[x];
                result[y * width + x] = count > 0;
            }
        }
        return result;
    }

private:
    std::int32_t& change_at(int x, int y)
    {
        return changes_[static_cast<std::size_t>(y - window_.y) *
                            (static_cast<std::size_t>(window_.width) + 1) +
                        static_cast<std::size_t>(x - window_.x)];
    }

    PixelRect window_;
    std::vector<std::int32_t> changes_; // one row and one column more than the window; empty: none were added
};

} // namespace plumb
