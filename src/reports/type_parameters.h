// SPDX-License-Identifier: MIT
#pragma once

// The parameters of a type, as its manual page has them.

#include "plumb/scene_file/scene_file.h"

#include <string>
#include <vector>

namespace plumb {

// A row of a manual page: "    alpha   float or texture   roughness, in [0, 1]   (default 0.1)".
struct TypeParameter {
    std::string name;
    std::string type;
    std::string description;
    std::string usual; // empty: it must be given, or the text says what happens
};

std::vector<TypeParameter> parameters_of(const TypeInfo& type);

} // namespace plumb
