// SPDX-License-Identifier: MIT
#pragma once

// One file for each format. Readers are for files that begin as their format does; what else a file says may be wrong.
// All throw Error with the reason, or std::bad_alloc. Nothing is printed.

#include "image/lean/raster.h"

namespace plumb::lean {

Raster read_png(const std::string& name);
Raster read_jpeg(const std::string& name);
Raster read_bmp(const std::string& name);
Raster read_tga(const std::string& name);
DecodedImage read_exr(const std::string& name);
void read_exr_words(const std::string& name, const ChooseChannels& choose, const UseRow& use);

std::vector<unsigned char> write_png(const ImageFile& image);
std::vector<unsigned char> write_jpeg(const ImageFile& image);
std::vector<unsigned char> write_exr(const ImageFile& image);
std::vector<unsigned char> write_exr_words(const WordImage& image, const FillRows& fill);

std::string jpeg_library(); // its name and version

} // namespace plumb::lean
