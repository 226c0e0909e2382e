// SPDX-License-Identifier: MIT
#pragma once

// The packets of tev's protocol over TCP that make and change an image (its README, "Inter-process communication", and
// include/tev/Ipc.h). All numbers are little endian:
//
//     packet    u32 length of the packet, this number included; u8 kind; content
//     create 4  u8 grab focus; name, 0; i32 width; i32 height; i32 channels; of each its name, 0
//     update 6  u8 grab focus; name, 0; i32 channels; of each its name, 0; i32 x; i32 y; i32 width; i32 height;
//               of each channel i64 offset and then of each channel i64 stride, in floats; the floats

#include "plumb/image/image.h"

#include <span>
#include <string>
#include <vector>

namespace plumb::tev {

using Packet = std::vector<unsigned char>;

Packet create_image(const std::string& name, int width, int height, std::span<const std::string> channels);

// values: of each pixel of the part, by rows, its channels.
Packet update_image(const std::string& name, std::span<const std::string> channels, const PixelRect& part,
                    std::span<const float> values);

} // namespace plumb::tev
