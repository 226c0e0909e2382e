// SPDX-License-Identifier: MIT
#pragma once

// A picture above the line of progress, drawn again and again in the same place.

#include "plumb/display/preview.h"
#include "plumb/display/terminal_picture.h"

#include <string>

namespace plumb {

// Characters, and the pixels in one of them.
struct TerminalSize {
    int columns = 80;
    int rows = 24;
    int cell_width = 10;
    int cell_height = 20;
};

class TerminalFrame {
public:
    TerminalFrame(const Preview& preview, TerminalGraphics graphics, bool true_color)
        : preview_(preview), graphics_(graphics), true_color_(true_color)
    {}

    // What draws the picture as it is now, in place of the one before; the cursor is in the line below it then, as it must be
    // when this is called again. The picture takes at most half of the terminal's lines.
    std::string draw(const TerminalSize& terminal);
    // What was drawn stays where it is: other text follows below, and then another picture.
    void leave() { lines_ = 0; }

private:
    const Preview& preview_;
    TerminalGraphics graphics_;
    bool true_color_;
    int lines_ = 0; // of the picture above the cursor
};

} // namespace plumb
