// SPDX-License-Identifier: MIT
#pragma once

// Standard output and standard error. Nothing else in src/cli prints. Names and texts that others chose are part of what is
// printed: nothing that would steer a terminal gets through here (visible_text.h).

#include "cli/terminal_frame.h"
#include "plumb/base/error.h"

#include <string_view>

namespace plumb {

// To be called first: a closed pipe is an error to report, not a signal to die of, and a standard stream that was
// closed stays closed to us instead of becoming the first file that is opened.
void prepare_console();

void print_log(std::string_view line); // to standard error, as one line, whatever it contains; never fails
void print_log(const Diagnostic& diagnostic);
// To standard output. Line ends and tabs stay; so texts of others in it should be visible_text() before, to be one line.
void print_output(std::string_view text);
void finish_output(); // throws Error if standard output could not take everything

// Standard error is a terminal that can redraw a line.
bool log_is_terminal();
int terminal_columns();       // of standard error; 80 where nobody knows
int output_columns();         // of standard output; 80 where it is no terminal
TerminalSize terminal_size(); // of standard error
// What steers the terminal: of our own making only. To standard error.
void draw_on_terminal(std::string_view text);
void redraw_line(std::string_view text); // replaces the line that the cursor is in; "" clears it

} // namespace plumb
