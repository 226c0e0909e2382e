// SPDX-License-Identifier: MIT
#include "render/sample_text.h"

#include <fmt/format.h>

namespace plumb {

std::string color_text(const Color& color)
{
    return fmt::format("{} {} {}", color.r, color.g, color.b);
}

std::string_view status_text(SampleStatus status)
{
    switch (status) {
    case SampleStatus::accepted: return "accepted";
    case SampleStatus::not_finite: return "not finite";
    case SampleStatus::negative: return "negative";
    case SampleStatus::out_of_range: return "out of the film's range";
    }
    return "unknown";
}

std::string rectangle_text(const PixelRect& rectangle)
{
    return fmt::format("{},{},{},{}", rectangle.x, rectangle.y, rectangle.width, rectangle.height);
}

std::string left_out_text(const LeftOut::Sample& sample)
{
    return fmt::format("sample {} of pixel {},{} ({}: {})", sample.index, sample.pixel.x, sample.pixel.y,
                       status_text(sample.status), color_text(sample.value));
}

} // namespace plumb
