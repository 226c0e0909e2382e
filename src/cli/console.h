// SPDX-License-Identifier: MIT
#pragma once

// Standard output and standard error. Nothing else in src/cli prints.

#include <string_view>

namespace plumb {

// To be called first: a closed pipe is an error to report, not a signal to die of, and a standard stream that was
// closed stays closed to us instead of becoming the first file that is opened.
void prepare_console();

void print_log(std::string_view text);    // to standard error, with a line end; never fails
void print_output(std::string_view text); // to standard output, as it is
void finish_output();                     // throws Error if standard output could not take everything

// Standard error is a terminal that can redraw a line.
bool log_is_terminal();
int terminal_columns();                  // of standard error; 80 where nobody knows
void redraw_line(std::string_view text); // replaces the line that the cursor is in; "" clears it

} // namespace plumb
