// SPDX-License-Identifier: MIT
#include "support/mesh_files.h"

#include <algorithm>

namespace plumb::test {

namespace {

constexpr float pyramid_vertices[5][5] = { // x y z u v
    {0, 0, 0, 0, 0},
    {2, 0, 0.5f, 1, 0.1f},
    {2, 0, 2, 1, 1},
    {0, 0, 2, 0.1f, 1},
    {1, 1.5f, 1, 0.4f, 0.6f}};

constexpr std::string_view obj_pyramid =
    "v 0 0 0\nv 2 0 0.5\nv 2 0 2\nv 0 0 2\nv 1 1.5 1\n"
    "vt 0 0\nvt 1 0.1\nvt 1 1\nvt 0.1 1\nvt 0.4 0.6\n"
    "f 5/5 2/2 1/1\nf 5/5 3/3 2/2\nf 5/5 4/4 3/3\nf 5/5 1/1 4/4\nf 1/1 2/2 3/3 4/4\n";

constexpr std::string_view ply_pyramid =
    "ply\nformat ascii 1.0\ncomment a pyramid\nelement vertex 5\nproperty float x\nproperty float y\n"
    "property float z\nproperty float u\nproperty float v\nelement face 5\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0 0 0\n2 0 0.5 1 0.1\n2 0 2 1 1\n0 0 2 0.1 1\n1 1.5 1 0.4 0.6\n"
    "3 4 1 0\n3 4 2 1\n3 4 3 2\n3 4 0 3\n4 0 1 2 3\n";

std::string serialized_pyramid()
{
    std::vector<float> numbers;
    for (const auto& vertex : pyramid_vertices) numbers.insert(numbers.end(), vertex, vertex + 3);
    for (const auto& vertex : pyramid_vertices) numbers.insert(numbers.end(), vertex + 3, vertex + 5);
    return serialized_file(
        {serialized_mesh(0x1002, 5, numbers, {4, 1, 0, 4, 2, 1, 4, 3, 2, 4, 0, 3, 0, 1, 2, 0, 2, 3})});
}

} // namespace

std::string zlib_stream(const std::string& data)
{
    std::string stream = "\x78\x01";
    std::uint32_t a = 1, b = 0; // Adler-32
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    for (std::size_t begin = 0;; begin += 0xffff) {
        const std::string block = data.substr(std::min(begin, data.size()), 0xffff);
        const bool is_last = begin + 0xffff >= data.size();
        const auto size = static_cast<std::uint16_t>(block.size());
        stream += is_last ? '\1' : '\0';
        stream += bytes_of({size, static_cast<std::uint16_t>(~size)}) + block;
        if (is_last) break;
    }
    return stream + bytes_of({b << 16 | a}, true);
}

std::string serialized_file(const std::vector<std::string>& meshes, std::uint16_t version)
{
    std::string file, table;
    for (const std::string& mesh : meshes) {
        table += version == 4 ? bytes_of({static_cast<std::uint64_t>(file.size())})
                              : bytes_of({static_cast<std::uint32_t>(file.size())});
        file += bytes_of<std::uint16_t>({0x041C, version}) + zlib_stream(mesh);
    }
    return file + table + bytes_of({static_cast<std::uint32_t>(meshes.size())});
}

std::string serialized_mesh(std::uint32_t flags, std::uint64_t vertices, const std::vector<float>& numbers,
                            const std::vector<std::uint32_t>& indices, std::uint16_t version)
{
    std::string data = bytes_of({flags});
    if (version == 4) data += std::string("name") + '\0';
    data += bytes_of({vertices, static_cast<std::uint64_t>(indices.size() / 3)});
    for (const float x : numbers) data += bytes_of({x});
    for (const std::uint32_t i : indices) data += bytes_of({i});
    return data;
}

std::string pyramid_file(const std::filesystem::path& name)
{
    if (name.extension() == ".obj") return std::string(obj_pyramid);
    if (name.extension() == ".ply") return std::string(ply_pyramid);
    if (name.extension() == ".serialized") return serialized_pyramid();
    return {};
}

} // namespace plumb::test
