// SPDX-License-Identifier: MIT
#include "reports/type_summary.h"

#include <algorithm>

namespace plumb {

std::string summary_of(std::string_view manual)
{
    std::string text(manual.substr(0, manual.find("\n\n")));
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.erase(text.find_last_not_of(' ') + 1); // npos + 1 is 0
    return text.substr(0, text.find(". ")) + (text.find(". ") == std::string::npos ? "" : ".");
}

} // namespace plumb
