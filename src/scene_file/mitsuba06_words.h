// SPDX-License-Identifier: MIT
#pragma once

// The words of Mitsuba 0.4 to 0.6, where they differ from those of Mitsuba 3. Parameters are in camelCase there; they
// become snake_case first, so that the rows of Mitsuba 3 fit.

#include "scene_file/vocabulary.h"

namespace plumb {

// base: the words of Mitsuba 3.
Vocabulary mitsuba06_vocabulary(const Vocabulary& base);

// "intIOR" as "int_ior".
std::string snake_case(std::string_view name);

} // namespace plumb
