// SPDX-License-Identifier: MIT

// Stands in for src/cli/console.cpp: what the program says is looked at, and not printed.

#include "base/visible_text.h"
#include "cli/console.h"
#include "fuzz/fuzz.h"

namespace plumb {

void prepare_console() {}

void print_log(std::string_view line)
{
    fuzz::expect_printable(visible_text(line)); // as src/cli/console.cpp does
}

void print_log(const Diagnostic& diagnostic)
{
    fuzz::expect_printable(diagnostic.text());
}

void print_output(std::string_view text)
{
    fuzz::expect_printable(visible_text(text));
}

void finish_output() {}

bool log_is_terminal()
{
    return false;
}

int terminal_columns()
{
    return 80;
}

int output_columns()
{
    return 80;
}

TerminalSize terminal_size()
{
    return {};
}

void draw_on_terminal(std::string_view) {}

void redraw_line(std::string_view) {}

} // namespace plumb
