// SPDX-License-Identifier: MIT
#pragma once

// A file's bytes, and reading them one after the other.

#include "plumb/base/error.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace plumb {

using Bytes = std::span<const unsigned char>;

class ImageFileBytes {
public:
    explicit ImageFileBytes(const std::string& name); // throws Error
    Bytes all() const { return {bytes_.get(), size_}; }

private:
    std::unique_ptr<unsigned char[]> bytes_;
    std::size_t size_ = 0;
};

// Numbers are little-endian. Throws Error where there is nothing more.
class ByteReader {
public:
    explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

    Bytes take(std::size_t count)
    {
        if (count > left()) throw Error("the file ends early");
        position_ += count;
        return bytes_.subspan(position_ - count, count);
    }
    void go_to(std::size_t position)
    {
        if (position > bytes_.size()) throw Error("the file ends early");
        position_ = position;
    }
    unsigned byte() { return take(1)[0]; }
    unsigned number16() { return number(2); }
    unsigned number32() { return number(4); }
    int integer32() { return static_cast<int>(number32()); }

    std::size_t position() const { return position_; }
    std::size_t left() const { return bytes_.size() - position_; }

private:
    unsigned number(std::size_t size)
    {
        unsigned value = 0;
        unsigned shift = 0;
        for (const unsigned char byte : take(size)) {
            value |= static_cast<unsigned>(byte) << shift;
            shift += 8;
        }
        return value;
    }

    Bytes bytes_;
    std::size_t position_ = 0;
};

} // namespace plumb
