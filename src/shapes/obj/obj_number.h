// SPDX-License-Identifier: MIT
#pragma once

// One number of an OBJ file.

#include <string>
#include <string_view>

namespace plumb {

struct ObjNumber {
    enum class Status { good, unreadable, not_finite, too_large };
    Status status = Status::good;
    float value = 0.f; // the nearest float; 0 for numbers too small to tell from it
};

// The whole of `token` must be one decimal number; a leading + is fine.
ObjNumber parse_obj_number(std::string_view token);

// The token for a message: at most 40 bytes of it, and none that a terminal would choke on.
std::string excerpt(std::string_view token);

} // namespace plumb
