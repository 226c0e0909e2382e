// SPDX-License-Identifier: MIT
#include "base/shell_words.h"

#include "base/visible_text.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <utility>

namespace plumb {

namespace {

// The character that a backslash in $'...' stands for, cut off the text together with it.
char take_escaped(std::string_view& text)
{
    const char kind = text.front();
    text.remove_prefix(1);
    if (kind == 'n') return '\n';
    if (kind == 't') return '\t';
    if (kind != 'x') return kind;
    unsigned value = 0;
    const auto [end, problem] =
        std::from_chars(text.data(), text.data() + std::min<std::size_t>(text.size(), 2), value, 16);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return static_cast<char>(static_cast<unsigned char>(value));
}

bool is_plain(std::string_view text)
{
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        if (length == 0 || steers(text.substr(0, length))) return false;
        text.remove_prefix(length);
    }
    return true;
}

} // namespace

std::vector<std::string> shell_split(std::string_view line)
{
    std::vector<std::string> words;
    enum class Quotes { none, plain, escapes } quotes = Quotes::none;
    bool inside = false; // a word
    while (!line.empty()) {
        const char c = line.front();
        line.remove_prefix(1);
        if (c == ' ' && quotes == Quotes::none) {
            inside = false;
            continue;
        }
        if (!std::exchange(inside, true)) words.emplace_back();
        if (quotes == Quotes::none && c == '$' && line.starts_with('\'')) {
            quotes = Quotes::escapes;
            line.remove_prefix(1);
        } else if (c == '\'') {
            quotes = quotes == Quotes::none ? Quotes::plain : Quotes::none;
        } else if (c == '\\' && quotes == Quotes::escapes && !line.empty()) {
            words.back() += take_escaped(line);
        } else if (c == '\\' && quotes == Quotes::none && !line.empty()) {
            words.back() += line.front();
            line.remove_prefix(1);
        } else {
            words.back() += c;
        }
    }
    return words;
}

std::string shell_quote(std::string_view word)
{
    constexpr std::string_view harmless =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!word.empty() && word.find_first_not_of(harmless) == std::string_view::npos) return std::string(word);
    if (!is_plain(word)) {
        std::string escaped = "$'";
        for (const char c : word) {
            const auto byte = static_cast<unsigned char>(c);
            if (byte < 0x20 || byte >= 0x7f)
                escaped += fmt::format("\\x{:02x}", byte);
            else if (c == '\'' || c == '\\')
                escaped += std::string("\\") + c;
            else
                escaped += c;
        }
        return escaped + "'";
    }
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    }
    return quoted + "'";
}

} // namespace plumb
