// SPDX-License-Identifier: MIT
#pragma once

// What no image may be, in the words of both image modules.

#include "plumb/base/error.h"
#include "plumb/image/image.h"

#include <cstddef>

namespace plumb {

// Throws Error for no pixels, no channels, and more values than any memory holds.
void check_size(const PixelRect& data, std::size_t channels);

// The pixels that exist, seen from the corner of the full image. Throws Error if they are too far from it.
PixelRect seen_from_corner(const PixelRect& data, const PixelRect& full);

Error not_enough_memory(const PixelRect& data);

} // namespace plumb
