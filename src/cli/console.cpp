// SPDX-License-Identifier: MIT
#include "cli/console.h"

#include "base/terminal_text.h"
#include "base/visible_text.h"
#include "plumb/base/error.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace plumb {

namespace {

int output_problem = 0; // errno of the first write to standard output that failed

void write_all(std::FILE* stream, std::string_view text, int& problem)
{
    if (text.empty()) return;
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stream) != text.size() && problem == 0)
        problem = errno ? errno : EIO;
}

void write_error(std::string_view text)
{
    int ignored = 0; // there is nowhere to complain
    write_all(stderr, text, ignored);
}

// By no-color.org.
bool has_colors()
{
    const char* none = std::getenv("NO_COLOR");
    return log_is_terminal() && !(none && *none);
}

// A message. Whatever steers a terminal is ours.
void write_message(const std::string& text)
{
    write_error((has_colors() ? with_colors(text) : text) + "\n");
}

int columns_of(int stream)
{
    winsize size{};
    if (ioctl(stream, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
    return size.ws_col;
}

} // namespace

void prepare_console()
{
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN); // a file-size limit is a write that fails, not the end
    for (const int stream : {0, 1, 2}) {
        if (fcntl(stream, F_GETFD) != -1) continue;
        // open() takes the lowest number that is free. Read-only: writing still fails, as it should.
        if (open("/dev/null", O_RDONLY) != stream) return;
    }
}

void print_log(std::string_view line)
{
    write_message(visible_text(line));
}

void print_log(const Diagnostic& diagnostic)
{
    write_message(diagnostic.text());
}

void print_output(std::string_view text)
{
    std::string shown;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\n\t"), text.size());
        shown += visible_text(text.substr(0, end));
        if (end < text.size()) shown += text[end];
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    write_all(stdout, shown, output_problem);
}

void finish_output()
{
    errno = 0;
    if (std::fflush(stdout) != 0 && output_problem == 0) output_problem = errno ? errno : EIO;
    // Whoever closed the pipe has read enough.
    if (output_problem != 0 && output_problem != EPIPE)
        throw Error(std::string("cannot write to standard output: ") + std::strerror(output_problem));
}

bool log_is_terminal()
{
    const char* terminal = std::getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && terminal && std::string_view(terminal) != "dumb";
}

int terminal_columns()
{
    return columns_of(STDERR_FILENO);
}

int output_columns()
{
    return columns_of(STDOUT_FILENO);
}

TerminalSize terminal_size()
{
    TerminalSize known;
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return known;
    known.columns = size.ws_col;
    known.rows = size.ws_row;
    if (size.ws_xpixel >= size.ws_col && size.ws_ypixel >= size.ws_row) { // few terminals say
        known.cell_width = size.ws_xpixel / size.ws_col;
        known.cell_height = size.ws_ypixel / size.ws_row;
    }
    return known;
}

void draw_on_terminal(std::string_view text)
{
    write_error(text);
}

void redraw_line(std::string_view text)
{
    write_error("\r" + std::string(text) + "\033[K");
}

} // namespace plumb
