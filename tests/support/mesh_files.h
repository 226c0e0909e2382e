// SPDX-License-Identifier: MIT
#pragma once

// Mesh files written in a test.

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace plumb::test {

// The bytes of numbers, little-endian unless `big`.
template <class T>
std::string bytes_of(std::initializer_list<T> values, bool big = false)
{
    std::string all;
    for (const T value : values) {
        std::string one(reinterpret_cast<const char*>(&value), sizeof(T));
        all += big ? std::string(one.rbegin(), one.rend()) : one;
    }
    return all;
}

// A zlib stream (RFC 1950) that holds `data` without compressing it.
std::string zlib_stream(const std::string& data);

// A .serialized file of these meshes: what follows the version of each is the stream of `meshes`, in version 4 or 3.
std::string serialized_file(const std::vector<std::string>& meshes, std::uint16_t version = 4);
// One mesh before it is compressed. flags as in the format; vertices: their numbers in the file's order.
std::string serialized_mesh(std::uint32_t flags, std::uint64_t vertices, const std::vector<float>& numbers,
                            const std::vector<std::uint32_t>& indices, std::uint16_t version = 4);

// A pyramid with texture coordinates, in the format that the file's name asks for; empty for other names.
std::string pyramid_file(const std::filesystem::path& name);

} // namespace plumb::test
