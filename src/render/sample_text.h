// SPDX-License-Identifier: MIT
#pragma once

// Samples and pixels in words.

#include "plumb/math/color.h"
#include "plumb/render/render.h"

#include <string>
#include <string_view>

namespace plumb {

std::string color_text(const Color& color);               // 0.5 1 nan
std::string_view status_text(SampleStatus status);        // "not finite"
std::string rectangle_text(const PixelRect& rectangle);   // X,Y,WIDTH,HEIGHT
std::string left_out_text(const LeftOut::Sample& sample); // "sample 17 of pixel 3,4 (not finite: nan 1 1)"

} // namespace plumb
