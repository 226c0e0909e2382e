// SPDX-License-Identifier: MIT
#pragma once

// Denoising with Open Image Denoise 2 (https://www.openimagedenoise.org), which is loaded when it is needed. It changes the
// expectation of every pixel by an unknown amount, and its bits depend on version and processor: what it makes is to be
// looked at, and never a reference.

#include "plumb/image/image.h"

#include <string>

namespace plumb {

// The colours denoised, guided by the layers albedo_behind and normal_behind, or else albedo and normal, if the image has
// them. Other layers stay; the error bars of the colours, which are not those of the result, do not. The header says what was done.
// threads: 0: all. Throws Error if the library cannot be loaded or used, or if the image has no colours.
Image denoised(const Image& image, int threads = 0);

// Throws Error, with where to get it, if the library cannot be loaded.
void check_denoiser();

// What was done to an image, by its header; empty: nothing is known.
std::string denoised_text(const Metadata& header);

} // namespace plumb
