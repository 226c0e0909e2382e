// SPDX-License-Identifier: MIT
#pragma once

// The door to zlib: numbers out of a compressed stream (RFC 1950).

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace plumb {

class Inflated {
public:
    // data: the stream, and perhaps more behind it; must outlive this.
    explicit Inflated(std::span<const char> data);
    ~Inflated();
    Inflated(const Inflated&) = delete;
    Inflated& operator=(const Inflated&) = delete;

    // Fills `bytes` with what comes next. Throws Error where the stream ends before, or is not one.
    void read(std::span<char> bytes);

    // At most how many bytes the stream still gives: what deflate packs into a byte is limited.
    std::uint64_t most_left() const;

private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

} // namespace plumb
