// SPDX-License-Identifier: MIT
#pragma once

// Pictures in a terminal, as text that a terminal draws.
//
// [1] kitty, "Terminal graphics protocol", https://sw.kovidgoyal.net/kitty/graphics-protocol/
// [2] DEC, VT330/VT340 Programmer Reference Manual, volume 2, chapter 14: sixel graphics

#include "plumb/image/image.h"

#include <functional>
#include <string>

namespace plumb {

enum class TerminalGraphics {
    blocks, // a character for two pixels, one above the other: any terminal with colours
    sixel,  // [2]
    kitty   // [1]
};

// By the environment of a terminal: variable(name) is its value, or null.
TerminalGraphics terminal_graphics(const std::function<const char*(const char*)>& variable);
bool has_true_color(const std::function<const char*(const char*)>& variable);

// images have 3 channels, encoded for sRGB. Each text leaves the cursor where it finds it in its first line, but for
// half_blocks(), which ends every line: height / 2 of them, rounded up.
std::string half_blocks(const ByteImage& image, bool true_color); // else the 256 colours of xterm
std::string sixel(const ByteImage& image);                        // in 216 colours, dithered
std::string kitty(const ByteImage& image, int columns,
                  int rows); // scaled to so many characters; replaces the last one

} // namespace plumb
