// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace plumb {

// The first sentence of a manual page, in one line.
std::string summary_of(std::string_view manual);

} // namespace plumb
