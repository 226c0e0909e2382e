// SPDX-License-Identifier: MIT

// Stands in for src/base/memory.cpp: a machine with little memory. Images that are too large for it are errors of ours then,
// on any machine, and not the end of the fuzzer.

#include "base/memory.h"

namespace plumb {

std::optional<std::uint64_t> available_memory()
{
    return std::uint64_t{64} << 20;
}

std::uint64_t peak_memory()
{
    return 0;
}

void prefer_large_pages(void*, std::size_t) {}

} // namespace plumb
