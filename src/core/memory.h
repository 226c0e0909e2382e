// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace plumb {

// How many bytes this process can still take without swapping, as far as the system tells.
std::optional<std::uint64_t> available_memory();

} // namespace plumb
