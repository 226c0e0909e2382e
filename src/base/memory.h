// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace plumb {

// How many bytes this process can still take without swapping, as far as the system tells.
std::optional<std::uint64_t> available_memory();

// The most bytes that this program has held so far. What getrusage() says is at least what the process held before it
// became this program: much, where a large program has started it.
std::uint64_t peak_memory();

// Asks the system for large pages there, as far as they fit in: memory that is all written comes with fewer waits.
void prefer_large_pages(void* begin, std::size_t bytes);

template <class T>
void reserve_large_pages(std::vector<T>& values, std::size_t count)
{
    values.reserve(count);
    prefer_large_pages(values.data(), count * sizeof(T));
}

} // namespace plumb
