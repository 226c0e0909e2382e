// SPDX-License-Identifier: MIT
#pragma once

// Where numbers are between black and white.

#include "plumb/display/layer_view.h"

#include <span>
#include <string>

namespace plumb {

class ShownNumbers {
public:
    // range: absent: from the smallest of the values to the largest, of a logarithmic one from the smallest above 0. Values
    // that are not finite do not count. Throws Error if the logarithm of the range's end does not exist.
    ShownNumbers(std::span<const float> values, const std::optional<NumberRange>& range, bool logarithmic);

    const NumberRange& range() const { return range_; }
    double place(float value) const; // from 0 to 1; clamped
    // "0.5 (black) to 12 (white), logarithmic"
    std::string text(const std::string& low, const std::string& high) const;

private:
    NumberRange range_;
    bool logarithmic_;
};

} // namespace plumb
