// SPDX-License-Identifier: MIT
#include "display/shown_numbers.h"

#include "plumb/base/error.h"
#include "plumb/math/elementary.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace plumb {

namespace {

NumberRange extremes(std::span<const float> values, bool positive)
{
    bool any = false;
    NumberRange found{0.0, 0.0};
    for (const float value : values) {
        if (!std::isfinite(value) || (positive && value <= 0.f)) continue;
        const auto x = static_cast<double>(value);
        found = any ? NumberRange{std::min(found.low, x), std::max(found.high, x)} : NumberRange{x, x};
        any = true;
    }
    return found;
}

} // namespace

ShownNumbers::ShownNumbers(std::span<const float> values, const std::optional<NumberRange>& range,
                           bool logarithmic)
    : range_(range ? *range : extremes(values, logarithmic)), logarithmic_(logarithmic)
{
    if (!logarithmic || range_.low > 0.0) return;
    throw Error(range ? fmt::format("a logarithmic range must begin above 0, not at {}", range_.low)
                      : "no value is above 0, and a logarithmic range needs some");
}

double ShownNumbers::place(float value) const
{
    if (!(range_.high > range_.low)) return 0.0;
    const auto x = std::clamp(static_cast<double>(value), range_.low, range_.high);
    return logarithmic_ ? log(x / range_.low) / log(range_.high / range_.low)
                        : (x - range_.low) / (range_.high - range_.low);
}

std::string ShownNumbers::text(const std::string& low, const std::string& high) const
{
    return fmt::format("{:.6g} ({}) to {:.6g} ({}){}", range_.low, low, range_.high, high,
                       logarithmic_ ? ", logarithmic" : "");
}

} // namespace plumb
