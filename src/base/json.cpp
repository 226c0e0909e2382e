// SPDX-License-Identifier: MIT
#include "base/json.h"

#include "base/visible_text.h"

#include <cmath>
#include <fmt/format.h>

namespace plumb {

std::string json_string(std::string_view text)
{
    std::string result = "\"";
    const std::string valid = valid_utf8(text);
    for (std::string_view rest = valid; !rest.empty();) {
        const std::string_view character = rest.substr(0, utf8_length(rest));
        rest.remove_prefix(character.size());
        if (character == "\"" || character == "\\")
            result.append("\\").append(character);
        else if (character == "\n")
            result += "\\n";
        else if (character == "\r")
            result += "\\r";
        else if (character == "\t")
            result += "\\t";
        else if (steers(character)) // a report may go to a terminal; none is beyond 16 bits
            result += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(code_point(character)));
        else
            result += character;
    }
    return result + "\"";
}

std::string json_number(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

void JsonWriter::begin(std::string_view key, char bracket)
{
    member(key, std::string_view(&bracket, 1));
    ++depth_;
    first_ = true;
}

void JsonWriter::end(char bracket)
{
    --depth_;
    if (!first_) text_ += "\n" + std::string(static_cast<std::size_t>(2 * depth_), ' ');
    text_ += bracket;
    first_ = false;
}

void JsonWriter::member(std::string_view key, std::string_view value)
{
    if (!first_) text_ += ",";
    if (depth_ > 0) text_ += "\n" + std::string(static_cast<std::size_t>(2 * depth_), ' ');
    if (!key.empty()) text_ += json_string(key) + ": ";
    text_ += value;
    first_ = false;
}

} // namespace plumb
