// SPDX-License-Identifier: MIT
#include "scene_file/spectrum_file.h"

#include "plumb/base/error.h"
#include "scene_file/document.h"

#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::size_t max_spectrum_size = std::size_t{1} << 20;

// Takes a number from the front of the text.
std::optional<double> take_number(std::string_view& text)
{
    text.remove_prefix(std::min(text.find_first_not_of(" \t,"), text.size()));
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc()) return {};
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

} // namespace

std::string read_spectrum_file(const std::filesystem::path& path)
{
    const std::string text = read_text(path);
    if (text.size() > max_spectrum_size)
        throw Error(fmt::format("'{}' is too large for a spectrum: {} bytes", path.string(), text.size()));
    std::string pairs;
    std::size_t line_number = 0;
    for (std::string_view rest = text; !rest.empty();) {
        std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        ++line_number;
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(" \t\r") == line.npos) continue;
        const auto wavelength = take_number(line), value = take_number(line);
        if (!wavelength || !value || line.find_first_not_of(" \t\r") != line.npos)
            throw Error(fmt::format("'{}', line {}: expected a wavelength and a value, as '550 0.5'",
                                    path.string(), line_number));
        pairs += fmt::format("{}{}:{}", pairs.empty() ? "" : ", ", *wavelength, *value);
    }
    if (pairs.empty()) throw Error(fmt::format("'{}' has no wavelengths", path.string()));
    return pairs;
}

} // namespace plumb
