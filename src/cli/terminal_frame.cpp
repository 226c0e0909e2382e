// SPDX-License-Identifier: MIT
#include "cli/terminal_frame.h"

#include <algorithm>
#include <fmt/format.h>

namespace plumb {

namespace {

std::string repeated(std::string_view text, int count)
{
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

} // namespace

std::string TerminalFrame::draw(const TerminalSize& terminal)
{
    const int most_lines = std::max(terminal.rows / 2, 1);
    const int most_columns = std::max(terminal.columns - 1, 1);
    const bool is_blocks = graphics_ == TerminalGraphics::blocks;
    const ByteImage picture =
        is_blocks ? preview_.picture(most_columns, 2 * most_lines)
                  : preview_.picture(most_columns * terminal.cell_width, most_lines * terminal.cell_height);
    const auto cells = [](int pixels, int in_cell) { return (pixels + in_cell - 1) / in_cell; };
    const int lines = is_blocks ? cells(picture.height, 2) : cells(picture.height, terminal.cell_height);

    // The lines must be there before: a terminal scrolls at its end.
    const bool is_in_place = lines_ == lines;
    std::string text = "\r";
    if (!is_in_place) text += repeated("\n", lines);
    text += fmt::format("\033[{}A", lines);
    lines_ = lines;
    if (is_blocks) return text + half_blocks(picture, true_color_);
    text += graphics_ == TerminalGraphics::kitty
                ? kitty(picture, cells(picture.width, terminal.cell_width), lines)
                : sixel(picture);
    return text + fmt::format("\r\033[{}B", lines);
}

} // namespace plumb
