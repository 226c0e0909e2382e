// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace plumb {

std::string_view plugin_source_manual(std::string_view class_name);

} // namespace plumb
