// SPDX-License-Identifier: MIT
#include "cli/text.h"

#include <array>
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

// The length of the well-formed UTF-8 sequence at the front (Unicode 15, table 3-7); 0 if there is none.
std::size_t utf8_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto continues = [&](std::size_t i) { return byte(i) >= 0x80 && byte(i) <= 0xbf; };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first <= 0xdf) return continues(1) ? 2 : 0;
    if (first >= 0xe0 && first <= 0xef) {
        const bool in_range = (first != 0xe0 || byte(1) >= 0xa0) && (first != 0xed || byte(1) <= 0x9f);
        return in_range && continues(1) && continues(2) ? 3 : 0;
    }
    if (first >= 0xf0 && first <= 0xf4) {
        const bool in_range = (first != 0xf0 || byte(1) >= 0x90) && (first != 0xf4 || byte(1) <= 0x8f);
        return in_range && continues(1) && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
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

std::vector<std::string> shell_split(std::string_view line)
{
    std::vector<std::string> words;
    bool quoted = false;
    bool inside = false; // a word
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == ' ' && !quoted) {
            inside = false;
            continue;
        }
        if (!std::exchange(inside, true)) words.emplace_back();
        if (c == '\'')
            quoted = !quoted;
        else if (c == '\\' && !quoted && i + 1 < line.size())
            words.back() += line[++i];
        else
            words.back() += c;
    }
    return words;
}

std::string shell_quote(std::string_view word)
{
    constexpr std::string_view harmless =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!word.empty() && word.find_first_not_of(harmless) == std::string_view::npos) return std::string(word);
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'')
            quoted += "'\\''";
        else
            quoted += c;
    }
    return quoted + "'";
}

std::string visible_text(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f)
            result += fmt::format("\\x{:02x}", byte);
        else
            result += c;
    }
    return result;
}

std::string valid_utf8(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        result += length > 0 ? text.substr(0, length) : std::string_view("\xef\xbf\xbd");
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return result;
}

} // namespace plumb
