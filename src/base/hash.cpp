// SPDX-License-Identifier: MIT
#include "plumb/base/hash.h"

#include <algorithm>
#include <bit>
#include <fstream>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::uint64_t c1 = 0x87c37b91114253d5u;
constexpr std::uint64_t c2 = 0x4cf5ad432745937fu;

// Up to eight bytes, little-endian.
std::uint64_t word(const unsigned char* bytes, std::size_t count)
{
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < count; ++i) result |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
    return result;
}

std::uint64_t mix_first(std::uint64_t k)
{
    return std::rotl(k * c1, 31) * c2;
}

std::uint64_t mix_second(std::uint64_t k)
{
    return std::rotl(k * c2, 33) * c1;
}

std::uint64_t finish(std::uint64_t k)
{
    k = (k ^ (k >> 33)) * 0xff51afd7ed558ccdu;
    k = (k ^ (k >> 33)) * 0xc4ceb9fe1a85ec53u;
    return k ^ (k >> 33);
}

} // namespace

void Hash128::mix_block(State& state, const unsigned char* block)
{
    state.h1 ^= mix_first(word(block, 8));
    state.h1 = (std::rotl(state.h1, 27) + state.h2) * 5 + 0x52dce729u;
    state.h2 ^= mix_second(word(block + 8, 8));
    state.h2 = (std::rotl(state.h2, 31) + state.h1) * 5 + 0x38495ab5u;
}

void Hash128::update(std::string_view bytes)
{
    size_ += bytes.size();
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    std::size_t left = bytes.size();
    if (pending_size_ > 0) {
        const std::size_t taken = std::min(left, sizeof pending_ - pending_size_);
        std::copy_n(data, taken, pending_ + pending_size_);
        pending_size_ += taken;
        data += taken;
        left -= taken;
        if (pending_size_ < sizeof pending_) return;
        mix_block(state_, pending_);
        pending_size_ = 0;
    }
    for (; left >= sizeof pending_; data += sizeof pending_, left -= sizeof pending_) mix_block(state_, data);
    std::copy_n(data, left, pending_);
    pending_size_ = left;
}

std::string Hash128::hex() const
{
    State end = state_;
    if (pending_size_ > 8) end.h2 ^= mix_second(word(pending_ + 8, pending_size_ - 8));
    if (pending_size_ > 0) end.h1 ^= mix_first(word(pending_, std::min<std::size_t>(pending_size_, 8)));
    end.h1 ^= size_;
    end.h2 ^= size_;
    end.h1 += end.h2;
    end.h2 += end.h1;
    end.h1 = finish(end.h1);
    end.h2 = finish(end.h2);
    end.h1 += end.h2;
    end.h2 += end.h1;
    return fmt::format("{:016x}{:016x}", end.h1, end.h2);
}

std::string hash_of_files(const std::vector<std::filesystem::path>& files)
{
    Hash128 hash;
    std::vector<char> block(1 << 20);
    for (const std::filesystem::path& name : files) {
        std::ifstream file(name, std::ios::binary);
        if (!file) return {};
        while (file) {
            file.read(block.data(), static_cast<std::streamsize>(block.size()));
            hash.update({block.data(), static_cast<std::size_t>(file.gcount())});
        }
        if (!file.eof()) return {};
    }
    return hash.hex();
}

} // namespace plumb
