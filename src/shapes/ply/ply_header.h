// SPDX-License-Identifier: MIT
#pragma once

// What a PLY file says about itself (Turk 1994, "The PLY Polygon File Format").

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> count_type; // of a list: how many values follow
};

struct PlyElement {
    std::string name; // "vertex"
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties; // at least one

    // The bytes of one, with lists of no values.
    std::size_t least_size() const;
};

struct PlyHeader {
    enum class Format { ascii, little_endian, big_endian };
    Format format = Format::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0; // bytes of the file up to its data
};

// Throws FileError, with line and column.
PlyHeader read_ply_header(const std::string& file, std::string_view text);

} // namespace plumb
