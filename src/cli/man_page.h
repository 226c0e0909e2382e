// SPDX-License-Identifier: MIT
#pragma once

// Manual pages for man(1), in the macros of man(7).

#include "cli/verb.h"

#include <string>

namespace plumb {

// "renderer", "renderer-compare": what the page is called, in section 1.
std::string man_name(const VerbHelp& verb);
std::string man_page(const Verb& verb);

} // namespace plumb
