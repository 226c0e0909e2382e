// SPDX-License-Identifier: MIT

// The door to OpenSSL's libcrypto.

#include "plumb/base/hash.h"

#include <array>
#include <fstream>

#include <fmt/format.h>

// The functions for SHA-256 alone, which OpenSSL 3 would rather have us call through EVP: that sets up the whole library,
// which takes as long as the rest of the program's start.
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>

namespace plumb {

namespace {

class Sha256 {
public:
    Sha256() { SHA256_Init(&state_); }
    void update(std::string_view bytes) { SHA256_Update(&state_, bytes.data(), bytes.size()); }
    std::string finish()
    {
        std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
        SHA256_Final(digest.data(), &state_);
        return fmt::format("{:02x}", fmt::join(digest, ""));
    }

private:
    SHA256_CTX state_;
};

} // namespace

std::string sha256(std::string_view bytes)
{
    Sha256 hash;
    hash.update(bytes);
    return hash.finish();
}

std::string sha256_of_file(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return {};
    Sha256 hash;
    std::vector<char> block(1 << 18);
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        hash.update({block.data(), static_cast<std::size_t>(stream.gcount())});
    }
    return stream.eof() ? hash.finish() : std::string();
}

} // namespace plumb
