// SPDX-License-Identifier: MIT
#pragma once

// Layers of ids: which object or material a pixel shows.

#include "plumb/display/layer_view.h"

#include <cstddef>

namespace plumb {

// Whether the channel holds ids: it is called so, or the header has their names.
bool is_of_ids(const Image& image, const std::string& channel);

// 0, for nothing, is black; neighbours in number differ in hue.
Color id_color(int id);

// The channel at `place`. The legend names every id in the image with its colour, and with what the header calls it.
ImageView view_ids(const Image& image, std::size_t place);

} // namespace plumb
