// SPDX-License-Identifier: MIT
#pragma once

// What has to be known of an image's file before a codec reads it.

#include <filesystem>

namespace plumb {

// Whether the file begins as a PNG file does and ends before its last chunk does. libpng gives up on such files by a
// jump that leaks what OpenImageIO holds, with a message that nobody understands.
bool is_truncated_png(const std::filesystem::path& path);

} // namespace plumb
