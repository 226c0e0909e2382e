// SPDX-License-Identifier: MIT

// Catch2 version 3 brings its own main(); version 2 makes it here.
#if PLUMB_CATCH2_MAJOR < 3
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
#endif
