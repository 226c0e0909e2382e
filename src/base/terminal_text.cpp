// SPDX-License-Identifier: MIT
#include "base/terminal_text.h"

#include "base/text.h"

#include <algorithm>
#include <vector>

namespace plumb {

namespace {

// ECMA-48, "select graphic rendition".
constexpr std::string_view bold = "\033[1m";
constexpr std::string_view red = "\033[1;31m";
constexpr std::string_view yellow = "\033[1;33m";
constexpr std::string_view plain = "\033[0m";

std::string in(std::string_view style, std::string_view text)
{
    return text.empty() ? std::string() : std::string(style).append(text).append(plain);
}

bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// 'names' are bold; an apostrophe follows a letter.
std::string with_bold_names(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        std::size_t begin = text.find('\'');
        while (begin != text.npos && begin > 0 && is_letter(text[begin - 1]))
            begin = text.find('\'', begin + 1);
        const std::size_t end = begin == text.npos ? text.npos : text.find('\'', begin + 1);
        if (end == text.npos) return result.append(text);
        result.append(text.substr(0, begin)).append(in(bold, text.substr(begin, end + 1 - begin)));
        text.remove_prefix(end + 1);
    }
    return result;
}

std::string line_with_colors(std::string_view line)
{
    for (const auto& [word, style] : {std::pair(std::string_view("error: "), red), {"warning: ", yellow}}) {
        const std::size_t at = line.find(word);
        // At the start, or behind a place.
        if (at == line.npos || (at > 0 && !line.substr(0, at).ends_with(": "))) continue;
        return in(bold, line.substr(0, at)) + in(style, word.substr(0, word.size() - 1)) + " " +
               with_bold_names(line.substr(at + word.size()));
    }
    return with_bold_names(line);
}

constexpr std::size_t written_columns = 80;

struct Line {
    std::size_t indent = 0; // of the lines that continue it
    std::string text;       // with the indent of the first line
};

std::size_t first_word(std::string_view text)
{
    return std::min(text.find(' '), text.size());
}

// Where the second column of "  --spp N      samples" begins; else where the text does.
std::size_t column_of(std::string_view line)
{
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    if (begin == 0) return 0;
    const std::size_t gap = line.find("  ", begin);
    return gap == line.npos ? begin : line.find_first_not_of(' ', gap);
}

// Joins the line with the one before it if that ended for lack of room.
bool joins(const Line& before, std::string_view line, std::size_t last_length)
{
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == line.npos || before.text.empty() || begin != before.indent) return false;
    const std::string_view text = line.substr(begin);
    if (text.starts_with("- ") || text.starts_with('<')) return false;
    return last_length + 1 + first_word(text) > written_columns - 2;
}

void append_wrapped(std::string& result, const Line& line, std::size_t columns)
{
    std::string_view rest = line.text;
    std::string indent;
    while (indent.size() + rest.size() > columns) {
        std::size_t end = rest.rfind(' ', columns - indent.size());
        // The indent of a first line is no place to break it.
        if (end == rest.npos || rest.find_first_not_of(' ') > end || (indent.empty() && end < line.indent))
            break;
        result.append(indent).append(rest.substr(0, rest.find_last_not_of(' ', end) + 1)).append("\n");
        rest.remove_prefix(end + 1);
        indent = std::string(std::min(line.indent, columns / 2), ' ');
    }
    result.append(indent).append(rest).append("\n");
}

} // namespace

std::string with_colors(std::string_view text)
{
    std::string result;
    // Behind the first line of a diagnostic are those of the file.
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += line_with_colors(text.substr(0, end));
    return result.append(text.substr(end));
}

std::string rewrapped(std::string_view text, int columns)
{
    if (columns == static_cast<int>(written_columns)) return std::string(text);
    std::vector<Line> lines;
    std::size_t last_length = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        if (!lines.empty() && joins(lines.back(), line, last_length))
            lines.back().text.append(" ").append(line.substr(line.find_first_not_of(' ')));
        else
            lines.push_back({column_of(line), std::string(line)});
        last_length = line.size();
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    std::string result;
    for (const Line& line : lines)
        append_wrapped(result, line, static_cast<std::size_t>(std::max(columns, 20)));
    return result;
}

} // namespace plumb
