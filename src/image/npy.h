// SPDX-License-Identifier: MIT
#pragma once

// Pixels for numpy.

#include "plumb/image/image.h"

namespace plumb {

// All channels of the data window as an array of 32-bit floats, [row, column, channel], in NumPy's format .npy 1.0
// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html). The file appears whole or not at all. Throws Error.
void write_npy(const std::filesystem::path& path, const Image& image);

} // namespace plumb
