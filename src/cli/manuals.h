// SPDX-License-Identifier: MIT
#pragma once

// What --help prints of a verb between its usage and its options.

#include <string_view>

namespace plumb {

std::string_view agree_manual();
std::string_view batch_manual();
std::string_view check_manual();
std::string_view compare_manual();
std::string_view merge_manual();
std::string_view new_manual();
std::string_view race_manual();
std::string_view rerun_manual();
std::string_view test_manual();

} // namespace plumb
