// SPDX-License-Identifier: MIT
#pragma once

// Images as text inside a web page.

#include "plumb/image/image.h"

#include <string>
#include <string_view>

namespace plumb {

std::string base64(std::string_view bytes); // RFC 4648

// Linear colours, four bytes a pixel: three mantissas m and their common exponent e, channel = (m + 1/2) 2^(e - 136) [1];
// all 0 is black, and an exponent of 255 is a pixel that is not finite. Negative values are black. Every `reduction` x
// `reduction` pixels become one, their mean.
//
// [1] Ward 1991, "Real pixels", Graphics Gems II
std::string shared_exponent_bytes(const Image& image, int reduction);

// Of one side.
int reduced_size(int pixels, int reduction);

} // namespace plumb
