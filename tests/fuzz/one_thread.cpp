// SPDX-License-Identifier: MIT

// Stands in for src/base/parallel.cpp: in order, so that one input always does the same, and one target takes one processor.

#include "base/parallel.h"

namespace plumb {

void parallel_for(std::size_t count, int, const std::function<void(std::size_t)>& part)
{
    for (std::size_t i = 0; i < count; ++i) part(i);
}

} // namespace plumb
