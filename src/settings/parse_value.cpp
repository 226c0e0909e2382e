// SPDX-License-Identifier: MIT
#include "settings/parse_value.h"

#include "plumb/base/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace plumb {

namespace {

// The whole text as a number; a leading + is fine.
template <class T>
std::optional<T> whole_number(std::string_view text)
{
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-')) return std::nullopt;
    }
    T value{};
    const char* end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, value);
    if (problem != std::errc() || stop != end) return std::nullopt;
    return value;
}

// The parts between the separators, as integers from 0 to max_side; nothing if they are not exactly `count`.
std::optional<std::vector<int>> integers(std::string_view text, char separator, std::size_t count)
{
    std::vector<int> values;
    for (bool more = true; more;) {
        const std::size_t end = text.find(separator);
        const auto value = whole_number<int>(text.substr(0, end));
        if (!value || *value < 0 || *value > max_side) return std::nullopt;
        values.push_back(*value);
        more = end != std::string_view::npos;
        if (more) text.remove_prefix(end + 1);
    }
    return values.size() == count ? std::optional(values) : std::nullopt;
}

template <class T>
T number_between(std::string_view option, std::string_view text, T min, T max)
{
    const auto value = whole_number<T>(text);
    if (!value || !std::isfinite(*value) || *value < min || *value > max)
        throw Error(fmt::format("{} must be a number from {} to {}, not '{}'", option, min, max, text));
    return *value;
}

} // namespace

std::uint64_t parse_integer(std::string_view option, std::string_view text, std::uint64_t min,
                            std::uint64_t max)
{
    const auto value = whole_number<std::uint64_t>(text);
    if (!value || *value < min || *value > max)
        throw Error(fmt::format("{} must be an integer from {} to {}, not '{}'", option, min, max, text));
    return *value;
}

float parse_number(std::string_view option, std::string_view text, float min, float max)
{
    return number_between<float>(option, text, min, max);
}

double parse_double(std::string_view option, std::string_view text, double min, double max)
{
    return number_between<double>(option, text, min, max);
}

double parse_duration(std::string_view option, std::string_view text)
{
    double unit = 1.0;
    std::string_view number = text;
    for (const auto& [letter, seconds] :
         {std::pair('s', 1.0), std::pair('m', 60.0), std::pair('h', 3600.0)}) {
        if (!text.ends_with(letter)) continue;
        unit = seconds;
        number.remove_suffix(1);
    }
    const auto value = whole_number<double>(number);
    if (!value || !(*value > 0.0) || !(*value * unit <= 1e9))
        throw Error(fmt::format("{} must be a time like 90, 90s, 10m or 2h, not '{}'", option, text));
    return *value * unit;
}

std::vector<std::string> parse_list(std::string_view option, std::string_view text)
{
    std::vector<std::string> words;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        words.emplace_back(text.substr(start, end - start));
        if (words.back().empty()) throw Error(fmt::format("{} has an empty element in '{}'", option, text));
        start = end + 1;
    }
    return words;
}

Vec2i parse_size(std::string_view option, std::string_view text)
{
    const auto values = integers(text, 'x', 2);
    if (!values || (*values)[0] == 0 || (*values)[1] == 0)
        throw Error(fmt::format("{} must be WIDTHxHEIGHT, integers from 1 to {} as in 640x480, not '{}'",
                                option, max_side, text));
    return {(*values)[0], (*values)[1]};
}

Vec2i parse_pixel(std::string_view option, std::string_view text)
{
    const auto values = integers(text, ',', 2);
    if (!values)
        throw Error(fmt::format("{} must be X,Y, integers from 0 to {} counted from the upper left corner, "
                                "not '{}'",
                                option, max_side, text));
    return {(*values)[0], (*values)[1]};
}

std::pair<std::uint64_t, std::uint64_t> parse_part(std::string_view option, std::string_view text)
{
    const auto values = integers(text, '/', 2);
    if (!values || (*values)[0] < 1 || (*values)[0] > (*values)[1])
        throw Error(fmt::format("{} must be K/N, part K of N from 1/N to N/N and N at most {}, not '{}'",
                                option, max_side, text));
    return {static_cast<std::uint64_t>((*values)[0]), static_cast<std::uint64_t>((*values)[1])};
}

PixelRect parse_rectangle(std::string_view option, std::string_view text)
{
    const auto values = integers(text, ',', 4);
    if (!values || (*values)[2] == 0 || (*values)[3] == 0)
        throw Error(fmt::format("{} must be X,Y,WIDTH,HEIGHT, integers with X and Y from 0 and WIDTH and "
                                "HEIGHT from 1 to {}, not '{}'",
                                option, max_side, text));
    return {(*values)[0], (*values)[1], (*values)[2], (*values)[3]};
}

std::string parse_word(std::string_view option, std::string_view text,
                       const std::vector<std::string_view>& words)
{
    if (std::find(words.begin(), words.end(), text) == words.end())
        throw Error(fmt::format("{} cannot be '{}'{}", option, text, way_out(text, words)));
    return std::string(text);
}

bool parse_switch(std::string_view option, std::string_view text)
{
    if (text != "true" && text != "false")
        throw Error(fmt::format("{} must be true or false, not '{}'", option, text));
    return text == "true";
}

std::pair<std::string, std::string> parse_definition(std::string_view option, std::string_view text)
{
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string_view::npos)
        throw Error(fmt::format("{} must be name=value, not '{}'", option, text));
    return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

} // namespace plumb
