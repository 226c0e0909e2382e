// SPDX-License-Identifier: MIT
#pragma once

// Names without what people write in different ways: upper and lower case, blanks, - and _.

#include "base/lower_case.h"

#include <string>
#include <string_view>

namespace plumb {

inline std::string folded(std::string_view name)
{
    std::string text;
    for (const char c : name)
        if (c != '_' && c != '-' && c != ' ') text += lower_case(c);
    return text;
}

} // namespace plumb
