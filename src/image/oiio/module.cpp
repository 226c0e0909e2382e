// SPDX-License-Identifier: MIT

// The way into libplumb_images.so.

#include "image/oiio/module.h"

#include <string_view>

// Null for a program of another version.
extern "C" const plumb::ImageModule* plumb_image_module(const char* version)
{
    static const plumb::OiioModule module;
    return std::string_view(version) == PLUMB_VERSION ? &module : nullptr;
}
