// SPDX-License-Identifier: MIT
#pragma once

// The integrity of a state file: the hash of its header, of its channels' names and of the hashes of its rows.

#include "plumb/base/hash.h"
#include "plumb/image/image.h"

#include <cstdint>
#include <span>

namespace plumb {

inline constexpr const char* state_hash_name = "plumb:stateHash";

// What of a file's header was written by us: not what the format adds.
Metadata state_header(const Metadata& header);

std::string hash_of_row(std::span<const std::uint32_t> row);

class StateHash {
public:
    // header: but for the hash itself, if it is there. word_channels: those of integers.
    StateHash(const Metadata& header, const std::vector<std::string>& word_channels);
    void add(std::string_view row_hash); // row by row, from the top
    std::string hex() const { return hash_.hex(); }

private:
    Hash128 hash_;
};

} // namespace plumb
