// SPDX-License-Identifier: MIT
#pragma once

// Radiance's images, by code of our own in both image modules: OpenImageIO knows the older one of their two encodings only
// as garbage, and its powers of 2 are not exact (2.4.7).

#include "image/image_module.h"

namespace plumb {

bool is_hdr(const std::string& name); // by what the file begins with

// Throw Error with the reason, or std::bad_alloc. The pixels are in a buffer of the module.
DecodedImage read_hdr(const ImageModule& module, const std::string& name);
std::vector<unsigned char> write_hdr(const ImageFile& image); // of floats

} // namespace plumb
