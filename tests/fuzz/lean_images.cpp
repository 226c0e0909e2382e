// SPDX-License-Identifier: MIT

// Stands in for src/image/image_module.cpp: the lean image module as a part of the program, which is compiled for fuzzing.

#include "image/image_module.h"
#include "image/lean/lean_module.h"

namespace plumb {

const ImageModule& image_module()
{
    static const LeanModule module;
    return module;
}

const std::string& ImageLibrary::hash()
{
    static const std::string none(32, '0');
    return none;
}

ImageLibrary::ImageLibrary() = default;
ImageLibrary::~ImageLibrary() = default;
void ImageLibrary::wait() {}

} // namespace plumb
