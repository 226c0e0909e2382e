// SPDX-License-Identifier: MIT
#pragma once

// The characters that structure an OBJ file. The text must end with two line ends, which stop every loop here.

namespace plumb {

inline bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

inline bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

inline bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

// A backslash right before a line end: the statement goes on in the next line.
inline bool is_continuation(const char* p)
{
    return p[0] == '\\' && is_line_end(p[1]);
}

inline const char* line_end(const char* p)
{
    while (!is_line_end(*p)) ++p;
    return p;
}

// The start of the next line; CR LF counts as one end.
inline const char* next_line(const char* p)
{
    p = line_end(p);
    return p[0] == '\r' && p[1] == '\n' ? p + 2 : p + 1;
}

// Continuations count as blanks.
inline const char* skip_blanks(const char* p)
{
    while (true) {
        while (is_blank(*p)) ++p;
        if (!is_continuation(p)) return p;
        p = next_line(p + 1);
    }
}

inline bool is_token_end(const char* p)
{
    return is_blank(*p) || is_line_end(*p) || is_continuation(p);
}

inline const char* token_end(const char* p)
{
    while (!is_token_end(p)) ++p;
    return p;
}

// Whether a token between p and `end`, in one line, begins with #.
inline bool has_comment(const char* p, const char* end)
{
    for (char before = ' '; p != end; before = *p++)
        if (*p == '#' && is_blank(before)) return true;
    return false;
}

// The line behind the statement at p. Comments are not continued: many end with a directory of Windows.
inline const char* next_statement(const char* p)
{
    while (true) {
        const char* const line = p;
        const char* const end = line_end(line);
        p = next_line(end);
        if (end == line || end[-1] != '\\' || has_comment(line, end)) return p;
    }
}

// Like next_line, but never inside a statement. p: not one of the first two characters.
inline const char* next_chunk(const char* p)
{
    while (true) {
        p = line_end(p);
        const bool is_second = p[0] == '\n' && p[-1] == '\r';
        const bool continued = p[is_second ? -2 : -1] == '\\';
        p = next_line(p);
        if (!continued) return p;
    }
}

} // namespace plumb
