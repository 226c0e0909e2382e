// SPDX-License-Identifier: MIT
#pragma once

// A 128-bit hash of bytes, to tell whether two pictures were made from the same files. Not for secrets.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// MurmurHash3_x64_128 by Austin Appleby (published in the public domain), seed 0, fed piece by piece: the hash of
// the pieces is the hash of what they make together, on machines of either byte order.
class Hash128 {
public:
    void update(std::string_view bytes);
    std::string hex() const; // of everything so far; 32 digits

private:
    struct State {
        std::uint64_t h1 = 0;
        std::uint64_t h2 = 0;
    };
    static void mix_block(State& state, const unsigned char* block);

    State state_;
    unsigned char pending_[16] = {}; // what does not fill a block
    std::size_t pending_size_ = 0;
    std::uint64_t size_ = 0;
};

// Of the bytes of the files, one after the other; empty if one cannot be read.
std::string hash_of_files(const std::vector<std::filesystem::path>& files);

} // namespace plumb
