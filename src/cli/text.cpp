// SPDX-License-Identifier: MIT
#include "cli/text.h"

#include <array>
#include <charconv>
#include <fmt/format.h>

namespace plumb {

namespace {

// x in [0, 1000) with three digits, rounded down.
std::string three_digits(double x)
{
    const int decimals = x < 10.0 ? 2 : x < 100.0 ? 1 : 0;
    const double scale = decimals == 2 ? 100.0 : decimals == 1 ? 10.0 : 1.0;
    return fmt::format("{:.{}f}", std::floor(x * scale) / scale, decimals);
}

} // namespace

std::string duration_text(double seconds)
{
    if (seconds >= 0.0 && seconds < 1.0)
        return fmt::format("{:.3f} s", std::floor(seconds * 1000.0) / 1000.0);
    if (seconds >= 1.0 && seconds < 60.0) return fmt::format("{:.1f} s", std::floor(seconds * 10.0) / 10.0);
    return clock_text(seconds);
}

std::string clock_text(double seconds)
{
    if (!(seconds >= 0.0 && seconds < 1e9)) return "?";
    const auto whole = static_cast<std::uint64_t>(seconds);
    const std::uint64_t hours = whole / 3600;
    if (hours == 0) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", hours, whole / 60 % 60, whole % 60);
}

std::string count_text(std::uint64_t count)
{
    if (count < 1000) return fmt::format("{}", count);
    double x = static_cast<double>(count);
    for (const char* unit : {"k", "M", "G", "T", "P"}) {
        x /= 1000.0;
        if (x < 1000.0) return fmt::format("{} {}", three_digits(x), unit);
    }
    return fmt::format("{} E", three_digits(x / 1000.0));
}

std::string rate_text(std::uint64_t rays, double seconds)
{
    const double rate = static_cast<double>(rays) / seconds / 1e6;
    if (!std::isfinite(rate)) return "? Mrays/s";
    return rate < 1000.0 ? three_digits(rate) + " Mrays/s" : fmt::format("{:.0f} Mrays/s", rate);
}

std::string color_text(const Color& color)
{
    return fmt::format("{} {} {}", color.r, color.g, color.b);
}

std::string_view verdict_text(Verdict verdict)
{
    switch (verdict) {
    case Verdict::accepted: return "accepted";
    case Verdict::not_finite: return "not finite";
    case Verdict::negative: return "negative";
    case Verdict::out_of_range: return "out of the film's range";
    }
    return "unknown";
}

std::string list_text(const std::vector<std::string>& items)
{
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i > 0) text += i + 1 < items.size() ? ", " : " and ";
        text += items[i];
    }
    return text;
}

std::string rectangle_text(const PixelRect& rectangle)
{
    return fmt::format("{},{},{},{}", rectangle.x, rectangle.y, rectangle.width, rectangle.height);
}

std::string lines_text(const std::vector<std::string>& items)
{
    std::string text;
    for (const std::string& item : items) text += (text.empty() ? "" : "\n") + item;
    return text;
}

std::vector<std::string> lines_of(std::string_view text)
{
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

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
