// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <sys/types.h>

namespace plumb {

// The most bytes that one process has held so far, of this one and those below it that live; 0: unknown. Linux only.
std::uint64_t peak_memory_below(pid_t process);

} // namespace plumb
