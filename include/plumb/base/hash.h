// SPDX-License-Identifier: MIT
#pragma once

// Hashes of bytes: SHA-256 where people compare it with that of other programs, a fast one of 128 bits where Plumb alone
// does and nobody is to be kept from forging it.

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

// SHA-256 as `sha256sum` prints it: 64 hexadecimal digits.
std::string sha256(std::string_view bytes);
std::string sha256_of_file(const std::filesystem::path& file); // empty if it cannot be read

} // namespace plumb
