// SPDX-License-Identifier: MIT
#pragma once

// The values of settings and options as text. The whole text must be a value in the range. Each function throws Error in
// the name of `option`.

#include "plumb/image/image.h"
#include "plumb/math/math.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumb {

std::uint64_t parse_integer(std::string_view option, std::string_view text, std::uint64_t min,
                            std::uint64_t max);
float parse_number(std::string_view option, std::string_view text, float min, float max);
double parse_double(std::string_view option, std::string_view text, double min, double max);
double parse_duration(std::string_view option, std::string_view text); // 90, 90s, 10m or 2h, as seconds
std::vector<std::string> parse_list(std::string_view option, std::string_view text); // a,b,c
Vec2i parse_size(std::string_view option, std::string_view text);                    // WxH
Vec2i parse_pixel(std::string_view option, std::string_view text);                   // X,Y
// K/N, with 1 <= K <= N
std::pair<std::uint64_t, std::uint64_t> parse_part(std::string_view option, std::string_view text);
PixelRect parse_rectangle(std::string_view option, std::string_view text); // X,Y,W,H
// One of the words, or an error that lists them.
std::string parse_word(std::string_view option, std::string_view text,
                       const std::vector<std::string_view>& words);
bool parse_switch(std::string_view option, std::string_view text); // true or false
std::pair<std::string, std::string> parse_definition(std::string_view option,
                                                     std::string_view text); // name=value

// The largest image has max_side x max_side pixels.
inline constexpr int max_side = 65535;

} // namespace plumb
