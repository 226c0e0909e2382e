// SPDX-License-Identifier: MIT
#include "base/xml_text.h"

#include "base/visible_text.h"

#include <fmt/format.h>

namespace plumb {

std::string xml_text(std::string_view text)
{
    std::string result;
    const std::string valid = valid_utf8(text);
    for (std::string_view rest = valid; !rest.empty();) {
        const std::string_view character = rest.substr(0, utf8_length(rest));
        rest.remove_prefix(character.size());
        const char32_t code = code_point(character);
        switch (code) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        case '\n': result += "&#10;"; break;
        case '\t': result += "&#9;"; break;
        case '\r': result += "&#13;"; break;
        default:
            if (code < 0x20 || code == 0xfffe || code == 0xffff)
                result += "?";
            else if (steers(character))
                result += fmt::format("&#{};", static_cast<std::uint32_t>(code));
            else
                result += character;
        }
    }
    return result;
}

} // namespace plumb
