// SPDX-License-Identifier: MIT
#include "cli/json.h"

#include "cli/text.h"

#include <cmath>
#include <fmt/format.h>

namespace plumb {

std::string json_string(std::string_view text)
{
    std::string result = "\"";
    for (const char c : valid_utf8(text)) {
        switch (c) {
        case '"': result += "\\\""; break;
        case '\\': result += "\\\\"; break;
        case '\n': result += "\\n"; break;
        case '\r': result += "\\r"; break;
        case '\t': result += "\\t"; break;
        default:
            if (static_cast<unsigned char>(c) < 0x20)
                result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
            else
                result += c;
        }
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
