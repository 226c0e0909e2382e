// SPDX-License-Identifier: MIT
#pragma once

// What the fuzz targets share.

#include "plumb/base/error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace plumb::fuzz {

// Of this process alone, in memory where the system has a place for that; gone when the process ends.
const std::filesystem::path& directory();

// A file in that directory.
std::filesystem::path write_file(std::string_view name, std::string_view content);

// Anything else is a finding: the process ends, and libFuzzer keeps the input.
void expect(bool holds, std::string_view what);

// No character that a terminal obeys: control characters but line ends and tabs, C1 controls, bidirectional controls.
void expect_printable(std::string_view text);

// Runs it. It may throw Error, UsageError or std::bad_alloc; all that they say must be printable. Anything else that is thrown
// is a finding: a message that none of us wrote. Whether nothing was thrown.
bool allow_our_errors(const std::function<void()>& action);

inline std::string_view text_of(const std::uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size};
}

} // namespace plumb::fuzz

// libFuzzer's.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
