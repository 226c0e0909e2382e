// SPDX-License-Identifier: MIT
#pragma once

// What our files of images have in common with OpenImageIO's idea of them; for src/image/oiio.

#include "plumb/image/image.h"

#include <OpenImageIO/imageio.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumb {

// The file at `name`, opened by a reader for what it holds. Throws Error with the reason.
std::unique_ptr<OIIO::ImageInput> open_image(const std::string& name);

// The pixels that exist, seen from the corner of the full image. Throws Error if they are too far from it.
PixelRect data_window_of(const OIIO::ImageSpec& spec);

Metadata metadata_of(const OIIO::ImageSpec& spec);
void put_metadata(OIIO::ImageSpec& spec, const Metadata& metadata);

// What a file of that name (its extension says the format) and spec will hold; `write` hands over the pixels and says
// whether that went well. Throws Error with the reason.
std::vector<unsigned char> encode_image(const std::string& name, const OIIO::ImageSpec& spec,
                                        const std::function<bool(OIIO::ImageOutput&)>& write);

} // namespace plumb
