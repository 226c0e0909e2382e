// SPDX-License-Identifier: MIT

// What a terminal can draw.

#include "plumb/display/terminal_picture.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace plumb {

namespace {

using Variable = std::function<const char*(const char*)>;

std::string_view value_of(const Variable& variable, const char* name)
{
    const char* const value = variable(name);
    return value ? value : std::string_view();
}

} // namespace

TerminalGraphics terminal_graphics(const Variable& variable)
{
    const std::string_view terminal = value_of(variable, "TERM");
    const std::string_view program = value_of(variable, "TERM_PROGRAM");
    const auto contains = [](std::string_view text, std::string_view part) {
        return text.find(part) != std::string_view::npos;
    };
    // Multiplexers draw characters; what else reaches the terminal behind them depends on their settings.
    if (!value_of(variable, "TMUX").empty() || terminal.starts_with("tmux") || terminal.starts_with("screen"))
        return TerminalGraphics::blocks;
    if (contains(terminal, "kitty") || !value_of(variable, "KITTY_WINDOW_ID").empty() ||
        contains(terminal, "ghostty") || program == "ghostty" || program == "WezTerm")
        return TerminalGraphics::kitty;
    if (contains(terminal, "sixel") || terminal.starts_with("foot") || terminal.starts_with("mlterm") ||
        program == "mintty" || program == "iTerm.app" || !value_of(variable, "KONSOLE_VERSION").empty())
        return TerminalGraphics::sixel;
    return TerminalGraphics::blocks;
}

bool has_true_color(const Variable& variable)
{
    const std::string_view color = value_of(variable, "COLORTERM");
    return color == "truecolor" || color == "24bit" || value_of(variable, "TERM").ends_with("-direct");
}

} // namespace plumb
