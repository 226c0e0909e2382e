// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace plumb {

// What happened along one path, in order, for people to read.
struct PathEvent {
    enum class Kind { ray, hit, escape, emission, direct, scatter, roulette, end };
    Kind kind;
    std::string text;
};

} // namespace plumb
