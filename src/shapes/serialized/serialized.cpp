// SPDX-License-Identifier: MIT

// The format is that of Mitsuba 0.6 (its documentation, section 8.1.5): little-endian, for each mesh the numbers 0x041C and
// 3 or 4 (two bytes each) and a zlib stream; at the end of the file where each mesh begins, and how many there are.

#include "base/memory.h"
#include "plumb/base/error.h"
#include "plumb/shapes/mesh.h"
#include "shapes/mesh_parts.h"
#include "shapes/serialized/inflated.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <new>
#include <system_error>

#include <fmt/format.h>

namespace plumb {

namespace {

constexpr std::uint16_t magic = 0x041C;
constexpr std::size_t longest_name = std::size_t{1} << 16;

enum Flag : std::uint32_t {
    has_normals = 0x0001,
    has_uvs = 0x0002,
    has_colors = 0x0008,
    single_precision = 0x1000,
    double_precision = 0x2000,
};

static_assert(std::endian::native == std::endian::little, "the file's numbers are read as they are");

template <class T>
T number_at(std::span<const char> bytes, std::size_t offset)
{
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

// The bytes of one mesh: its header and its stream, with whatever stands behind that.
struct MeshBytes {
    std::uint16_t version;
    std::span<const char> stream;
};

MeshBytes find_mesh(std::span<const char> file, std::uint32_t index)
{
    if (file.size() < 4 || number_at<std::uint16_t>(file, 0) != magic)
        throw Error("it is not a .serialized file: it must begin with the number 0x041C");
    const auto version = number_at<std::uint16_t>(file, 2);
    if (version != 3 && version != 4)
        throw Error(fmt::format("it has version {} of the format; known are 3 and 4", version));
    const std::size_t size_of_offset = version == 4 ? 8 : 4;

    if (file.size() < 8) throw Error("the file ends too early");
    const auto count = number_at<std::uint32_t>(file, file.size() - 4);
    if (count == 0 || count > (file.size() - 8) / size_of_offset)
        throw Error(fmt::format("its last number should be how many meshes it has, and is {}", count));
    if (index >= count)
        throw Error(fmt::format("it has {} mesh{}, so there is no shapeIndex {}", count,
                                count == 1 ? "" : "es", index));

    const std::size_t table = file.size() - 4 - count * size_of_offset;
    const std::size_t entry = table + index * size_of_offset;
    const std::uint64_t begin =
        version == 4 ? number_at<std::uint64_t>(file, entry) : number_at<std::uint32_t>(file, entry);
    if (begin > table || table - begin < 4)
        throw Error(fmt::format("mesh {} should begin at byte {}, and the meshes end at byte {}", index,
                                begin, table));
    const std::span<const char> mesh = file.subspan(begin, table - begin);
    if (number_at<std::uint16_t>(mesh, 0) != magic)
        throw Error(fmt::format("there is no mesh at byte {}, where mesh {} should begin", begin, index));
    const auto own_version = number_at<std::uint16_t>(mesh, 2);
    if (own_version != 3 && own_version != 4)
        throw Error(
            fmt::format("mesh {} has version {} of the format; known are 3 and 4", index, own_version));
    return {own_version, mesh.subspan(4)};
}

class SerializedReader {
public:
    explicit SerializedReader(const MeshBytes& bytes) : version_(bytes.version), stream_(bytes.stream) {}

    MeshData read()
    {
        const auto flags = next<std::uint32_t>();
        if (version_ == 4) skip_name();
        const auto vertices = next<std::uint64_t>();
        const auto triangles = next<std::uint64_t>();
        const bool is_double = (flags & double_precision) != 0;
        if (is_double == ((flags & single_precision) != 0))
            throw Error(fmt::format(
                "its flags {:#x} must say either single (0x1000) or double (0x2000) precision", flags));
        check_size(flags, vertices, triangles);

        MeshData mesh;
        reserve_large_pages(mesh.positions, vertices + 1); // MeshData
        mesh.positions.resize(vertices);
        read_floats(is_double, {&mesh.positions[0][0], 3 * vertices}, 3, "the position");
        if (flags & has_normals) {
            mesh.normals.resize(vertices);
            read_floats(is_double, {&mesh.normals[0][0], 3 * vertices}, 3, "the normal");
        }
        if (flags & has_uvs) {
            mesh.uvs.resize(vertices);
            read_floats(is_double, {&mesh.uvs[0][0], 2 * vertices}, 2, "the texture coordinate");
        }
        if (flags & has_colors) {
            MeshAttribute colors{"vertex_color", false, 3, std::vector<float>(3 * vertices)};
            read_floats(is_double, colors.values, 3, "the colour");
            mesh.attributes.push_back(std::move(colors));
        }
        reserve_large_pages(mesh.triangles, triangles);
        mesh.triangles.resize(triangles);
        stream_.read(
            {reinterpret_cast<char*>(mesh.triangles.data()), triangles * sizeof(MeshData::Triangle)});
        for (std::size_t i = 0; i < triangles; ++i)
            for (const std::uint32_t corner : mesh.triangles[i])
                if (corner >= vertices)
                    throw Error(
                        fmt::format("triangle {} has corner {}; the mesh has {} vertices, counted from 0", i,
                                    corner, vertices));
        tidy_mesh(mesh);
        return mesh;
    }

private:
    template <class T>
    T next()
    {
        char bytes[sizeof(T)];
        stream_.read(bytes);
        return std::bit_cast<T>(bytes);
    }

    void skip_name()
    {
        for (std::size_t i = 0; next<char>() != '\0'; ++i)
            if (i == longest_name) throw Error("its name does not end");
    }

    // Before memory is taken for what the header announces.
    void check_size(std::uint32_t flags, std::uint64_t vertices, std::uint64_t triangles) const
    {
        constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
        if (vertices == 0 || triangles == 0) throw Error("it has no triangles");
        if (vertices > most || triangles > most)
            throw Error(fmt::format("{} vertices and {} triangles are more than 32-bit indices can count",
                                    vertices, triangles));
        const std::uint64_t floats =
            3 + (flags & has_normals ? 3 : 0) + (flags & has_uvs ? 2 : 0) + (flags & has_colors ? 3 : 0);
        const std::uint64_t needed =
            vertices * floats * (flags & double_precision ? 8 : 4) + triangles * sizeof(MeshData::Triangle);
        if (needed > stream_.most_left())
            throw Error(fmt::format("it announces {} vertices and {} triangles, for which it is too short",
                                    vertices, triangles));
    }

    // `width`: numbers of a vertex.
    void read_floats(bool is_double, std::span<float> values, std::size_t width, const char* what)
    {
        if (is_double) {
            std::vector<double> part(std::min<std::size_t>(values.size(), 1u << 16));
            for (std::size_t i = 0; i < values.size(); i += part.size()) {
                part.resize(std::min(part.size(), values.size() - i));
                stream_.read({reinterpret_cast<char*>(part.data()), part.size() * sizeof(double)});
                for (std::size_t k = 0; k < part.size(); ++k) values[i + k] = static_cast<float>(part[k]);
            }
        } else {
            stream_.read({reinterpret_cast<char*>(values.data()), values.size() * sizeof(float)});
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::abs(values[i]) <= largest_position) continue;
            throw Error(fmt::format("{} of vertex {} is {:.6g}; numbers must be finite and at most {:.3g}",
                                    what, i / width, values[i], largest_position));
        }
    }

    std::uint16_t version_;
    Inflated stream_;
};

} // namespace

MeshData read_serialized(const std::filesystem::path& path, std::uint32_t index)
{
    const auto fail = [&](const std::string& reason) -> MeshData {
        throw Error(fmt::format("cannot read '{}': {}", path.string(), reason));
    };
    try {
        const FileBytes content = read_file_bytes(path);
        return SerializedReader(find_mesh(content.view(), index)).read();
    } catch (const std::bad_alloc&) {
        return fail("not enough memory");
    } catch (const std::system_error& error) { // no thread to be had
        return fail(error.what());
    } catch (const Error& error) {
        if (std::string_view(error.what()).starts_with("cannot read")) throw;
        return fail(error.what());
    }
}

} // namespace plumb
