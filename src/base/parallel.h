// SPDX-License-Identifier: MIT
#pragma once

// Work that is cut into independent parts.

#include <cstddef>
#include <functional>

namespace plumb {

// Calls part(0), ..., part(count - 1), each once, on as many threads (0: all there are), in any order: what comes out
// must not depend on it. What a part throws comes out of this function.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& part);

} // namespace plumb
