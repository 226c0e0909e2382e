// SPDX-License-Identifier: MIT
#include "render/sample_text.h"

#include <fmt/format.h>

namespace plumb {

std::string color_text(const Color& color)
{
    return fmt::format("{} {} {}", color.r, color.g, color.b);
}

std::string_view verdict_text(Verdict verdict)
{
    switch (verdict) {
    case Verdict::accepted: return "accepted";
    case Verdict::not_finite: return "not finite";
    case Verdict::negative: return "negative";
    case Verdict::out_of_range: return "out of the film's range";
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
                       verdict_text(sample.verdict), color_text(sample.value));
}

} // namespace plumb
