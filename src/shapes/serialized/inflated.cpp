// SPDX-License-Identifier: MIT
#include "shapes/serialized/inflated.h"

#include "plumb/base/error.h"

#include <algorithm>
#include <limits>
#include <new>

#include <zlib.h>

namespace plumb {

struct Inflated::Stream {
    z_stream z{};
    std::span<const char> rest; // what z has not been given
};

namespace {

// More than 258 bytes for two bits, the shortest code of the longest match.
constexpr std::uint64_t largest_ratio = 1100;
constexpr std::size_t most_at_once = std::size_t{1} << 30; // zlib counts with 32 bits

} // namespace

Inflated::Inflated(std::span<const char> data) : stream_(std::make_unique<Stream>())
{
    stream_->rest = data;
    if (inflateInit(&stream_->z) != Z_OK) throw std::bad_alloc();
}

Inflated::~Inflated()
{
    inflateEnd(&stream_->z);
}

void Inflated::read(std::span<char> bytes)
{
    z_stream& z = stream_->z;
    while (!bytes.empty()) {
        if (z.avail_in == 0) {
            const std::size_t size = std::min(stream_->rest.size(), most_at_once);
            // zlib does not write there; its type has no const unless ZLIB_CONST is defined everywhere.
            z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(stream_->rest.data()));
            z.avail_in = static_cast<uInt>(size);
            stream_->rest = stream_->rest.subspan(size);
        }
        const std::size_t wanted = std::min(bytes.size(), most_at_once);
        z.next_out = reinterpret_cast<Bytef*>(bytes.data());
        z.avail_out = static_cast<uInt>(wanted);
        const int status = inflate(&z, Z_NO_FLUSH);
        bytes = bytes.subspan(wanted - z.avail_out);
        if (status == Z_MEM_ERROR) throw std::bad_alloc();
        const bool more_input = z.avail_in > 0 || !stream_->rest.empty();
        if (status == Z_DATA_ERROR || status == Z_NEED_DICT) throw Error("its compressed data is damaged");
        if (!bytes.empty() && (status == Z_STREAM_END || !more_input))
            throw Error("its compressed data ends too early");
    }
}

std::uint64_t Inflated::most_left() const
{
    const std::uint64_t input = stream_->z.avail_in + static_cast<std::uint64_t>(stream_->rest.size());
    return (input + 64) * largest_ratio; // the decoder may hold some bits, and a piece of its window
}

} // namespace plumb
