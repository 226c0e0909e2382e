// SPDX-License-Identifier: MIT
#include "base/text.h"

#include <algorithm>
#include <cmath>
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

std::string list_text(const std::vector<std::string>& items)
{
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i > 0) text += i + 1 < items.size() ? ", " : " and ";
        text += items[i];
    }
    return text;
}

std::vector<std::string> list_items(std::string_view text)
{
    std::vector<std::string> items;
    while (!text.empty()) {
        std::string_view item = text.substr(0, text.find(','));
        text.remove_prefix(std::min(item.size() + 1, text.size()));
        item.remove_prefix(std::min(item.find_first_not_of(' '), item.size()));
        item = item.substr(0, item.find_last_not_of(' ') + 1); // npos + 1 is 0
        if (!item.empty()) items.emplace_back(item);
    }
    return items;
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

} // namespace plumb
