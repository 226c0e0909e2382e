// SPDX-License-Identifier: MIT
#pragma once

// Numbers and words for people.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

std::string duration_text(double seconds);   // 0.123 s, 12.3 s, 4:05, 1:00:09: rounded down
std::string clock_text(double seconds);      // 0:04, 4:05, 1:00:09: rounded down; "?" if it cannot be known
std::string count_text(std::uint64_t count); // 999, 12.3 k, 4.56 M, 7.89 G: three digits, rounded down
std::string rate_text(std::uint64_t rays, double seconds);    // 12.3 Mrays/s
std::string list_text(const std::vector<std::string>& items); // a, b and c
// Of "a, b,c": what stands between commas, without the blanks around it; nothing where nothing stands.
std::vector<std::string> list_items(std::string_view text);
std::string lines_text(const std::vector<std::string>& items); // one a line, no line end after the last
std::vector<std::string> lines_of(
    std::string_view text); // the inverse, for items without line ends that are not empty

} // namespace plumb
