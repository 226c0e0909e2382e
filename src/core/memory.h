// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace plumb {

// How many bytes this process can still take without swapping, as far as the system tells.
std::optional<std::uint64_t> available_memory();

// The most bytes that this program has held so far. What getrusage() says is at least what the process held before it
// became this program: much, where a large program has started it.
std::uint64_t peak_memory();

} // namespace plumb
