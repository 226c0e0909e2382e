// SPDX-License-Identifier: MIT
#pragma once

// Catch2 version 2 (Debian 12) or 3, whichever the build found.

#if PLUMB_CATCH2_MAJOR >= 3
#include <catch2/catch_all.hpp>
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;
#else
#include <catch2/catch.hpp>
inline auto ContainsSubstring(const std::string& text)
{
    return Catch::Matchers::Contains(text);
}
#endif
