// SPDX-License-Identifier: MIT
#pragma once

// The characters that structure an OBJ file. The text must end with a line end, which stops every loop here.

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

inline const char* skip_blanks(const char* p)
{
    while (is_blank(*p)) ++p;
    return p;
}

inline const char* token_end(const char* p)
{
    while (!is_blank(*p) && !is_line_end(*p)) ++p;
    return p;
}

// The start of the next line; CR LF counts as one end.
inline const char* next_line(const char* p)
{
    while (!is_line_end(*p)) ++p;
    return p[0] == '\r' && p[1] == '\n' ? p + 2 : p + 1;
}

} // namespace plumb
