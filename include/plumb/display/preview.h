// SPDX-License-Identifier: MIT
#pragma once

// A small picture of an image while it is made.

#include "plumb/image/image.h"

#include <mutex>
#include <span>
#include <vector>

namespace plumb {

class Preview {
public:
    // Of the pixels of the window; black at first.
    Preview(const PixelRect& window, const Development& development);

    // values: of each pixel of the part, by rows, so many channels; the first three are red, green and blue. From any thread.
    void update(const PixelRect& part, std::span<const float> values, std::size_t channels);

    // With the proportions of the window, where pixels are as wide as they are high: as large as fits. Each of its pixels is
    // the mean of those it covers, developed.
    ByteImage picture(int most_columns, int most_rows) const;

private:
    const PixelRect window_;
    const Development development_;
    mutable std::mutex mutex_;  // of the values
    std::vector<float> values_; // red, green and blue of each pixel
};

} // namespace plumb
