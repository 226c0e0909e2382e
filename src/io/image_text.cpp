// SPDX-License-Identifier: MIT

#include "io/image_text.h"

namespace plumb {

std::string one_line(std::string_view text)
{
    std::string line;
    for (const char c : text) {
        const bool blank = static_cast<unsigned char>(c) <= ' ';
        if (!blank)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && (line.back() == ' ' || line.back() == '.')) line.pop_back();
    return line;
}

std::string reason_text(std::string_view text)
{
    if (text.find("bad_alloc") != std::string_view::npos) return "not enough memory";
    std::string reason = one_line(text);
    if (reason.empty()) return "for an unknown reason; there may be too little memory";
    if (reason.find("failed to map segment") != std::string::npos)
        reason += "; there may be too little memory";
    return reason;
}

} // namespace plumb
