// SPDX-License-Identifier: MIT
#pragma once

// Metals and other absorbing materials by name.

#include "plumb/math/color.h"

#include <span>
#include <string_view>

namespace plumb {

struct ConductorMaterial {
    std::string_view name;
    Color eta; // real part of the index of refraction
    Color k;   // imaginary part
};

std::span<const ConductorMaterial> conductor_materials();

} // namespace plumb
